// Reads MFEM meshes, versions 1.0, 1.2 and 1.3: hexes and tets with their attributes as regions,
// squares of the boundary as patches, named by the attribute sets of version 1.3. An attribute
// without a name is known by its number: "attribute_2", "bdr_attribute_3".
//
// An attribute in several sets is called by the smallest; those of one set are NAME.1, NAME.2.
// Nodes may be a function in H1 of degree 1 or 2, in the order in which the library numbers them
// (see the writer).
//
// Based on: "MFEM mesh formats" of the library's documentation. Differs: elements of other shapes
// in three dimensions, nodes of other degrees and non-conforming, NURBS and inline meshes are
// refused.
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <fmt/format.h>

#include "hexwright/mesh/hex_adjacency.h"

#include "io/content/foreign_labels.h"
#include "io/content/set_names.h"
#include "io/sets/face_table.h"
#include "io/solver/mfem_order.h"
#include "io/surface/polygon_soup.h"
#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"

namespace hexwright::io {
namespace {

enum Geometry : std::int64_t { Point, Segment, Triangle, Square, Tetrahedron, Cube };
/// Vertices of each geometry; prisms and pyramids are 6 and 7.
constexpr std::array<std::size_t, 8> kNumVerts = {1, 2, 3, 4, 4, 8, 6, 5};

/// Attributes that one name unites.
struct AttributeSet {
  std::string name;
  std::set<std::int64_t> attributes;
};

struct RawElement {
  std::int64_t attribute = 0, geometry = 0;
  std::array<std::int64_t, 8> verts{};
};

/// The degree of nodes in a collection such as "H1_3D_P2"; 0: another one.
int degree_of(std::string_view collection) {
  if (collection == "H1_3D_P1" || collection == "Linear") return 1;
  if (collection == "H1_3D_P2" || collection == "Quadratic") return 2;
  return 0;
}

class MfemReader {
 public:
  explicit MfemReader(const VolumeSource& source)
      : scanner_(source.bytes, source.name), name_(source.name) {}

  VolumeFile run() {
    read_version();
    while (scanner_.skip_blank()) {
      const std::string section(scanner_.token());
      if (section == "mfem_mesh_end") break;
      read_section(section);
    }
    if (file_.positions.empty()) scanner_.fail("the file has no vertices; export it again");
    settle_labels(file_);
    names_.apply(file_);
    return std::move(file_);
  }

 private:
  void read_version() {
    const std::string first(scanner_.rest_of_line());
    for (const char* known : {"MFEM mesh v1.0", "MFEM mesh v1.2", "MFEM mesh v1.3"})
      if (first.starts_with(known)) return;
    scanner_.set_line(1);
    scanner_.fail(in_quotes(first) +
                  " is none of the versions that are read (MFEM mesh v1.0, v1.2, v1.3); save a "
                  "conforming mesh by Mesh::Save");
  }

  void read_section(const std::string& section) {
    if (section == "dimension")
      read_dimension();
    else if (section == "elements")
      elements_ = read_elements();
    else if (section == "boundary")
      boundary_ = read_elements();
    else if (section == "attribute_sets")
      read_sets(element_sets_);
    else if (section == "bdr_attribute_sets")
      read_sets(boundary_sets_);
    else if (section == "vertices")
      read_vertices();
    else if (section == "nodes")
      read_nodes();
    else
      scanner_.fail("expected the name of a section, found " + in_quotes(section) +
                    "; a count above is wrong, export the file again");
  }

  void read_dimension() {
    if (scanner_.integer("the dimension") != 3)
      scanner_.fail("the mesh is not one in three dimensions; give a volume mesh");
  }

  std::vector<RawElement> read_elements() {
    if (num_verts_ > 0)
      scanner_.fail("elements stand behind the vertices, which use them; export the file again");
    std::vector<RawElement> elements(scanner_.count_of("the number of elements", 4));
    for (RawElement& element : elements) {
      element.attribute = scanner_.integer("an attribute");
      element.geometry = scanner_.integer("a geometry");
      if (element.geometry < 0 || element.geometry > 7)
        scanner_.fail("there is no geometry " + std::to_string(element.geometry) +
                      "; the file is damaged, export it again");
      if (element.geometry > Cube)
        scanner_.fail("the mesh has prisms or pyramids; give a mesh of hexes");
      for (std::size_t k = 0; k < kNumVerts[static_cast<std::size_t>(element.geometry)]; ++k)
        element.verts[k] = scanner_.integer("a vertex of the element");
    }
    return elements;
  }

  /// "name in quotes", how many attributes, and these; over any number of lines.
  void read_sets(std::vector<AttributeSet>& sets) {
    const std::size_t count = scanner_.count_of("the number of sets", 4);
    for (std::size_t s = 0; s < count; ++s) {
      AttributeSet set{read_name(), {}};
      for (std::size_t left = scanner_.count_of("the number of attributes", 2); left > 0; --left)
        set.attributes.insert(scanner_.integer("an attribute of the set"));
      sets.push_back(std::move(set));
    }
  }

  /// Names may hold blanks and '#'.
  std::string read_name() {
    scanner_.skip_blank();
    TextScanner ahead = scanner_;
    const std::string_view line = ahead.rest_of_line();
    const auto last = line.find('"', 1);
    if (!line.starts_with('"') || last == std::string_view::npos)
      scanner_.fail("expected the name of a set in quotes, found " + in_quotes(line) +
                    "; export the file again");
    scanner_.take(last + 1);
    return std::string(line.substr(1, last - 1));
  }

  /// The number of vertices, and their positions unless a section of nodes has them.
  void read_vertices() {
    if (num_verts_ > 0) scanner_.fail("the vertices come twice; export the file again");
    num_verts_ = scanner_.count_of("the number of vertices", 1);
    const std::string_view next = scanner_.peek_token();
    const bool has_positions = next != "nodes";
    if (has_positions && scanner_.integer("the dimension of positions") != 3)
      scanner_.fail("the vertices have not three coordinates; give a volume mesh");
    if (has_positions) {
      for (std::size_t v = 0; v < num_verts_; ++v) {
        scanner_.skip_blank();
        file_.positions.push_back(scanner_.line_point("a vertex"));
      }
      add_elements();
    }
  }

  VertId vert(std::int64_t index) {
    if (index < 0 || index >= static_cast<std::int64_t>(num_verts_))
      throw bad_file(name_, fmt::format("an element uses vertex {} of {}; the file is damaged, "
                                        "export it again",
                                        index, num_verts_));
    return VertId(static_cast<std::size_t>(index));
  }
  template <std::size_t N>
  std::array<VertId, N> verts_of(const RawElement& element) {
    std::array<VertId, N> verts;
    for (std::size_t k = 0; k < N; ++k) verts[k] = vert(element.verts[k]);
    return verts;
  }

  void add_elements() {
    std::vector<std::int64_t> regions, patches;
    for (const RawElement& element : elements_)
      if (element.geometry == Cube) {
        file_.hexes.push_back(verts_of<8>(element));
        regions.push_back(element.attribute);
      } else if (element.geometry == Tetrahedron) {
        file_.tets.push_back(verts_of<4>(element));
      } else {
        ++file_.num_others;
      }
    for (const RawElement& side : boundary_)
      if (side.geometry == Square) {
        file_.labels.quads.push_back({verts_of<4>(side), {}});
        patches.push_back(side.attribute);
      } else {
        ++file_.num_others;
      }
    const auto to_region = number_attributes(SetKind::Region, regions, element_sets_, "attribute");
    for (const std::int64_t a : regions) file_.region.push_back(to_region.at(a));
    const auto to_patch =
        number_attributes(SetKind::Patch, patches, boundary_sets_, "bdr_attribute");
    for (std::size_t q = 0; q < patches.size(); ++q)
      file_.labels.quads[q].patch = PatchId(to_patch.at(patches[q]));
  }

  std::map<std::int64_t, std::int32_t> number_attributes(SetKind kind,
                                                         const std::vector<std::int64_t>& used,
                                                         const std::vector<AttributeSet>& sets,
                                                         const char* unnamed) {
    std::map<std::int64_t, std::string> tags;
    for (const std::int64_t attribute : used) tags[attribute];
    for (auto& [attribute, name] : tags) {
      name = name_of(attribute, sets);
      if (name.empty()) name = fmt::format("{}_{}", unnamed, attribute);
    }
    return number_tags(kind, tags, names_);
  }

  static std::string name_of(std::int64_t attribute, const std::vector<AttributeSet>& sets) {
    const AttributeSet* best = nullptr;
    for (const AttributeSet& set : sets)
      if (set.attributes.contains(attribute) &&
          (!best || set.attributes.size() < best->attributes.size()))
        best = &set;
    if (!best || best->attributes.size() == 1) return best ? best->name : "";
    const auto rank = std::distance(best->attributes.begin(), best->attributes.find(attribute));
    return fmt::format("{}.{}", best->name, rank + 1);
  }

  /// "FiniteElementCollection: H1_3D_P2": what stands behind the colon.
  std::string_view value_of(const char* key) {
    if (const std::string_view found = scanner_.token(); found != key)
      scanner_.fail(
          fmt::format("expected {}, found {}; export the file again", key, in_quotes(found)));
    return scanner_.token();
  }

  void read_nodes() {
    if (!file_.positions.empty()) scanner_.fail("positions come twice; export the file again");
    if (scanner_.token() != "FiniteElementSpace")
      scanner_.fail("the nodes are no FiniteElementSpace; export the file again");
    const std::string collection(value_of("FiniteElementCollection:"));
    const int degree = degree_of(collection);
    if (degree == 0)
      scanner_.fail("nodes in " + in_quotes(collection) +
                    " are not read; set the mesh's curvature to order 1 or 2 in H1");
    if (value_of("VDim:") != "3") scanner_.fail("the nodes have not three coordinates");
    const bool is_by_point = value_of("Ordering:") == "1";
    for (std::size_t v = 0; v < num_verts_; ++v) file_.positions.push_back({});
    add_elements();
    if (!file_.tets.empty() && degree == 2)
      scanner_.fail("tets of second order are not read; give a mesh of hexes");
    degree == 2 ? read_quadratic(is_by_point) : set_verts(read_points(num_verts_, is_by_point));
  }

  std::vector<Vec3> read_points(std::size_t count, bool is_by_point) {
    if (count > scanner_.bytes_left() / 6 + 1)
      scanner_.fail("there are fewer positions than the " + std::to_string(count) +
                    " nodes of the mesh; it is truncated or damaged, export it again");
    std::vector<Vec3> points(count);
    if (is_by_point)
      for (Vec3& p : points)
        for (int axis = 0; axis < 3; ++axis) p[axis] = scanner_.real("a position");
    else
      for (int axis = 0; axis < 3; ++axis)
        for (Vec3& p : points) p[axis] = scanner_.real("a position");
    return points;
  }

  void set_verts(const std::vector<Vec3>& points) {
    for (std::size_t v = 0; v < num_verts_; ++v) file_.positions[VertId(v)] = points[v];
  }

  void read_quadratic(bool is_by_point) {
    HexMesh mesh;
    mesh.positions = file_.positions;
    mesh.hexes = file_.hexes;
    MidNodes nodes = make_straight_mid_nodes(mesh);
    const auto neighbors = compute_hex_neighbors(mesh);
    if (!neighbors.non_conforming.empty())
      throw bad_file(name_, "three hexes share a face; the file is damaged, export it again");
    const auto hex_to_face = number_mfem_faces(neighbors);
    const std::size_t first_face = num_verts_ + nodes.edges.size();
    std::size_t num_faces = 0;
    for (const auto& faces : hex_to_face)
      for (const std::size_t f : faces) num_faces = std::max(num_faces, f + 1);
    const auto points = read_points(first_face + num_faces + mesh.num_hexes(), is_by_point);
    set_verts(points);
    for (EdgeId e : nodes.edges.ids()) nodes.edges[e] = points[num_verts_ + e.index()];
    nodes.inner.resize(mesh.num_hexes());
    for (HexId h : mesh.hexes.ids()) {
      for (std::size_t lf = 0; lf < 6; ++lf)
        nodes.inner[h][lf] = points[first_face + hex_to_face[h][lf]];
      nodes.inner[h][6] = points[first_face + num_faces + h.index()];
    }
    file_.mid_nodes = std::move(nodes);
  }

  TextScanner scanner_;
  const std::string& name_;
  VolumeFile file_;
  SetNames names_;
  std::size_t num_verts_ = 0;
  std::vector<RawElement> elements_, boundary_;
  std::vector<AttributeSet> element_sets_, boundary_sets_;
};

}  // namespace

VolumeFile read_mfem(const VolumeSource& source) { return MfemReader(source).run(); }

}  // namespace hexwright::io
