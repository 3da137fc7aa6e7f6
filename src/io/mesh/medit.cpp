// MEDIT .mesh in text form: reads and writes hexes, tets, and labels (Quadrilaterals with the
// patch, Edges with the curve, Corners).
//
// Reference numbers: a hex's is its region; a quad's or edge's is its patch or curve plus one, 0
// for none. Names of regions, patches and curves stand in comments, "# patch 3 inlet", which other
// readers pass over.
//
// Based on: Frey, "MEDIT: an interactive mesh visualization software", INRIA technical report 253,
// 2001 (keywords and their fields; indices from 1).
#include <algorithm>
#include <charconv>
#include <limits>

#include "io/content/set_names.h"
#include "io/content/volume_file.h"
#include "io/surface/polygon_soup.h"
#include "io/text/text_scanner.h"
#include "io/text/text_writer.h"

namespace hexwright::io {
namespace {

/// Sections may come in any order, but vertices come before what uses them, as all writers do.
class MeditReader {
 public:
  explicit MeditReader(const VolumeSource& source) : scanner_(source.bytes, source.name) {}

  VolumeFile run() {
    while (scanner_.skip_blank()) {
      const std::string_view keyword = scanner_.token();
      if (keyword == "End") break;
      read_section(keyword);
    }
    if (file_.labels.corners.empty()) file_.labels.corners = std::move(required_);
    if (!has_regions_) file_.region.clear();
    return std::move(file_);
  }

 private:
  void read_section(std::string_view keyword) {
    if (keyword == "MeshVersionFormatted")
      scanner_.integer("the format's version");
    else if (keyword == "Dimension")
      read_dimension();
    else if (keyword == "Vertices")
      read_vertices();
    else if (keyword == "Hexahedra")
      read_hexes();
    else if (keyword == "Tetrahedra")
      read_tets();
    else if (keyword == "Quadrilaterals")
      read_labels<4>(file_.labels.quads);
    else if (keyword == "Edges")
      read_labels<2>(file_.labels.edges);
    else if (keyword == "Corners")
      read_points(file_.labels.corners);
    else if (keyword == "RequiredVertices")
      read_points(required_);
    else
      skip_section(keyword);
  }

  void read_dimension() {
    if (scanner_.integer("the dimension") != 3)
      scanner_.fail("the mesh is not three-dimensional; give a volume mesh");
  }

  /// References of vertices are read over: nothing here has a use for them.
  void read_vertices() {
    const std::size_t count = scanner_.count_of("the number of vertices", 8);
    file_.positions.reserve(count);
    for (std::size_t v = 0; v < count; ++v) {
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis) p[axis] = scanner_.real("a vertex");
      scanner_.integer("a vertex's reference");
      file_.positions.push_back(p);
    }
  }

  /// Indices count from 1.
  VertId read_vert() {
    const std::int64_t index = scanner_.integer("a vertex index");
    if (index < 1 || index > static_cast<std::int64_t>(file_.positions.size()))
      scanner_.fail("vertex " + std::to_string(index) + " does not exist: the vertices above are " +
                    "1 to " + std::to_string(file_.positions.size()) + "; export the file again");
    return VertId(index - 1);
  }
  std::int32_t read_ref() {
    const std::int64_t ref = scanner_.integer("an element's reference");
    if (ref < std::numeric_limits<std::int32_t>::min() ||
        ref > std::numeric_limits<std::int32_t>::max())
      scanner_.fail("the reference " + std::to_string(ref) +
                    " does not fit in 32 bits; correct it or export the file again");
    return static_cast<std::int32_t>(ref);
  }
  template <std::size_t N>
  std::array<VertId, N> read_verts() {
    std::array<VertId, N> verts;
    for (VertId& v : verts) v = read_vert();
    return verts;
  }

  void read_hexes() {
    const std::size_t count = scanner_.count_of("the number of hexahedra", 18);
    file_.hexes.reserve(count);
    for (std::size_t h = 0; h < count; ++h) {
      file_.hexes.push_back(read_verts<8>());
      file_.region.push_back(read_ref());
      has_regions_ |= file_.region.back() != 0;
    }
  }

  void read_tets() {
    const std::size_t count = scanner_.count_of("the number of tetrahedra", 10);
    file_.tets.reserve(count);
    for (std::size_t t = 0; t < count; ++t) {
      file_.tets.push_back(read_verts<4>());
      read_ref();
    }
  }

  /// Quads and edges alike: their vertices, then a reference that is the label plus one.
  template <std::size_t N, class Labeled>
  void read_labels(std::vector<Labeled>& out) {
    const std::size_t count = scanner_.count_of("the number of labelled elements", 2 * (N + 1));
    for (std::size_t i = 0; i < count; ++i) {
      const auto verts = read_verts<N>();
      out.push_back({verts, ref_to_label<decltype(label_of(Labeled{}))>(read_ref())});
    }
  }
  static PatchId label_of(const LabeledQuad& quad) { return quad.patch; }
  static CurveId label_of(const LabeledEdge& edge) { return edge.curve; }

  void read_points(std::vector<VertId>& out) {
    const std::size_t count = scanner_.count_of("the number of corners", 2);
    for (std::size_t i = 0; i < count; ++i) out.push_back(read_vert());
  }

  /// Passes over a section nobody needs: all numbers up to the next keyword.
  void skip_section(std::string_view keyword) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    if (!is_letter(keyword[0]))
      scanner_.fail("expected the name of a section, found " + in_quotes(keyword) +
                    "; a count above is wrong or this is no MEDIT file, export it again");
    bool is_count = true;
    for (auto next = scanner_.peek_token(); !next.empty() && !is_letter(next[0]);
         next = scanner_.peek_token()) {
      const std::string_view number = scanner_.token();
      const bool is_element =
          keyword == "Triangles" || keyword == "Prisms" || keyword == "Pyramids";
      if (is_count && is_element)
        file_.num_others += static_cast<std::size_t>(
            std::max<std::int64_t>(0, scanner_.to_integer(number, "a count")));
      is_count = false;
    }
  }

  TextScanner scanner_;
  VolumeFile file_;
  std::vector<VertId> required_;
  bool has_regions_ = false;
};

struct NamedKind {
  SetKind kind;
  std::string_view word;
  std::int32_t ref_minus_number;
};
constexpr NamedKind kNamedKinds[] = {
    {SetKind::Region, "region", 0}, {SetKind::Patch, "patch", 1}, {SetKind::Curve, "curve", 1}};

/// Sets that have a name of their own, before the vertices.
void write_names(const SetTable& table, TextWriter& out) {
  for (const NamedKind& kind : kNamedKinds)
    for (const NamedSet& set : kind.kind == SetKind::Region  ? table.regions
                               : kind.kind == SetKind::Patch ? table.patches
                                                             : table.curves) {
      if (set.number < 0 || !set.is_given) continue;
      out.text("# ").text(kind.word).text(" ");
      out.integer(std::int64_t{set.number} + kind.ref_minus_number).text(" ");
      out.text(set.name).text("\n");
    }
}

/// "# patch 3 inlet" in the lines before the vertices.
void read_names(std::string_view text, SetNames& names) {
  for (std::size_t end = 0; !text.empty(); text.remove_prefix(std::min(end + 1, text.size()))) {
    end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (!line.starts_with('#') && line.find("Vertices") != std::string_view::npos) return;
    for (const NamedKind& kind : kNamedKinds) {
      const std::string start = "# " + std::string(kind.word) + " ";
      if (!line.starts_with(start)) continue;
      line.remove_prefix(start.size());
      std::int32_t ref = 0;
      const auto number = std::from_chars(line.data(), line.data() + line.size(), ref);
      if (number.ec == std::errc() && number.ptr < line.data() + line.size() && *number.ptr == ' ')
        names.add(kind.kind, std::int64_t{ref} - kind.ref_minus_number,
                  {number.ptr, static_cast<std::size_t>(line.data() + line.size() - number.ptr)});
    }
  }
}

}  // namespace

VolumeFile read_medit(const VolumeSource& source) {
  VolumeFile file = MeditReader(source).run();
  SetNames names;
  read_names(source.bytes, names);
  names.apply(file);
  return file;
}

NameRules medit_names() { return {}; }

/// Coordinates have the fewest digits that give the same double back.
std::string medit_text(const HexMesh& mesh, const SetTable& table) {
  TextWriter out;
  const auto section = [&](const char* name, std::size_t count) {
    out.text("\n").text(name).text("\n").integer(count).text("\n");
  };
  out.text("MeshVersionFormatted 2\nDimension 3\n");
  write_names(table, out);
  section("Vertices", mesh.num_verts());
  for (const Vec3& p : mesh.positions) out.point(p).text(" 0\n");
  section("Hexahedra", mesh.num_hexes());
  for (HexId h : mesh.hexes.ids())
    out.indices(mesh.hexes[h], 1)
        .text(" ")
        .integer(mesh.region.empty() ? 0 : mesh.region[h])
        .text("\n");
  const BoundaryLabels& labels = mesh.labels;
  if (!labels.quads.empty()) section("Quadrilaterals", labels.quads.size());
  for (const LabeledQuad& quad : labels.quads)
    out.indices(quad.verts, 1).text(" ").integer(label_to_ref(quad.patch)).text("\n");
  if (!labels.edges.empty()) section("Edges", labels.edges.size());
  for (const LabeledEdge& edge : labels.edges)
    out.indices(edge.verts, 1).text(" ").integer(label_to_ref(edge.curve)).text("\n");
  if (!labels.corners.empty()) section("Corners", labels.corners.size());
  for (VertId v : labels.corners) out.integer(v.value() + 1).text("\n");
  out.text("\nEnd\n");
  return out.take();
}

}  // namespace hexwright::io
