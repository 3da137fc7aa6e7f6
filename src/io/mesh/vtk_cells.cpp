// Between hex meshes and VTK's unstructured grids.
//
// Cells are the hexes alone, so that viewers and solvers see a pure hex mesh; the labels travel in
// the field data, which every program keeps and none interprets. A named set is an array of the
// field data under the set's name: its number and its dimension (3 regions, 2 patches, 1 curves),
// as other programs keep Gmsh's physical groups.
#include "io/mesh/vtk_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/content/read_mid_nodes.h"
#include "io/content/set_names.h"
#include "io/surface/polygon_soup.h"
#include "io/text/file_bytes.h"

namespace hexwright::io {
namespace {

constexpr const char* kQuads = "boundary_quads";
constexpr const char* kQuadPatch = "boundary_quad_patch";
constexpr const char* kEdges = "feature_edges";
constexpr const char* kEdgeCurve = "feature_edge_curve";
constexpr const char* kCorners = "corners";
/// Says how many arrays of the field data are names of sets.
constexpr const char* kNamedSets = "named_sets";

int dimension_of(SetKind kind) {
  return kind == SetKind::Region ? 3 : kind == SetKind::Curve ? 1 : 2;
}

class VtkConverter {
 public:
  VtkConverter(VtkGrid&& grid, const std::string& name) : grid_(std::move(grid)), name_(name) {}

  VolumeFile run() {
    if (grid_.is_polygons)
      throw bad_file(name_,
                     "the file holds polygons (PolyData), not an UnstructuredGrid; give a "
                     "mesh of hexes");
    file_.positions = std::move(grid_.positions);
    region_ = find_cell_array({"region", "medit:ref"});
    patch_ = find_cell_array({"patch"});
    curve_ = find_cell_array({"curve"});
    for_each_cell(grid_, name_, [&](std::size_t index, std::span<const std::int64_t> cell) {
      cell_ = index;
      add_cell(cell);
    });
    read_field_data();
    mid_nodes_.settle(file_, name_);
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw bad_element(name_, "cell " + std::to_string(cell_),
                      message + "; the file is damaged, export it again");
  }

  const VtkArray* find_cell_array(std::initializer_list<std::string_view> names) const {
    for (std::string_view name : names) {
      const auto found = grid_.cell_data.find(name);
      if (found != grid_.cell_data.end() && found->second.num_components == 1 &&
          found->second.values.size() == grid_.ends.size())
        return &found->second;
    }
    return nullptr;
  }

  template <std::size_t N>
  std::array<VertId, N> to_verts(std::span<const std::int64_t> cell) const {
    if (cell.size() != N)
      fail("it has " + std::to_string(cell.size()) + " vertices instead of " + std::to_string(N));
    std::array<VertId, N> verts;
    for (std::size_t i = 0; i < N; ++i) {
      if (cell[i] < 0 || cell[i] >= static_cast<std::int64_t>(file_.positions.size()))
        fail("it uses vertex " + std::to_string(cell[i]) + " of " +
             std::to_string(file_.positions.size()));
      verts[i] = VertId(cell[i]);
    }
    return verts;
  }

  /// Labels are stored as numbers of any type; what is none of 32 bits is no label.
  std::int32_t integer_at(const VtkArray* array, std::size_t i) const {
    if (!array) return -1;
    const double value = array->values[i];
    const bool fits = value >= std::numeric_limits<std::int32_t>::min() &&
                      value <= std::numeric_limits<std::int32_t>::max();  // not so for NaN
    return fits ? static_cast<std::int32_t>(value) : -1;
  }

  void add_hex(const std::array<VertId, 8>& verts) {
    file_.hexes.push_back(verts);
    if (region_) file_.region.push_back(integer_at(region_, cell_));
  }

  template <std::size_t N>
  void add_quadratic_hex(std::span<const std::int64_t> cell) {
    const auto nodes = to_verts<N>(cell);
    std::array<VertId, 8> corners;
    std::copy(nodes.begin(), nodes.begin() + 8, corners.begin());
    add_hex(corners);
    mid_nodes_.add(file_, nodes);
  }

  /// The corners of a quad or edge of second order.
  template <std::size_t N>
  std::array<VertId, N> to_corners(std::span<const std::int64_t> cell,
                                   std::size_t num_nodes) const {
    if (cell.size() != num_nodes)
      fail("it has " + std::to_string(cell.size()) + " vertices instead of " +
           std::to_string(num_nodes));
    return to_verts<N>(cell.first(N));
  }

  void add_quad(const std::array<VertId, 4>& verts) {
    file_.labels.quads.push_back({verts, to_id<PatchId>(integer_at(patch_, cell_))});
  }
  void add_edge(const std::array<VertId, 2>& verts) {
    file_.labels.edges.push_back({verts, to_id<CurveId>(integer_at(curve_, cell_))});
  }

  /// VTK's hexahedron has our order; its voxel has lattice order, so two pairs change places.
  void add_cell(std::span<const std::int64_t> cell) {
    switch (grid_.types[cell_]) {
      case VtkHexahedron:
        return add_hex(to_verts<8>(cell));
      case VtkVoxel: {
        const auto v = to_verts<8>(cell);
        return add_hex({v[0], v[1], v[3], v[2], v[4], v[5], v[7], v[6]});
      }
      case VtkTetra:
        file_.tets.push_back(to_verts<4>(cell));
        return;
      case VtkQuadraticHexahedron:
        return add_quadratic_hex<20>(cell);
      case VtkTriquadraticHexahedron:
        return add_quadratic_hex<27>(cell);
      case VtkQuad:
        return add_quad(to_verts<4>(cell));
      case VtkQuadraticQuad:
        return add_quad(to_corners<4>(cell, 8));
      case VtkBiquadraticQuad:
        return add_quad(to_corners<4>(cell, 9));
      case VtkLine:
        return add_edge(to_verts<2>(cell));
      case VtkQuadraticEdge:
        return add_edge(to_corners<2>(cell, 3));
      case VtkVertex:
        file_.labels.corners.push_back(to_verts<1>(cell)[0]);
        return;
      default:
        ++file_.num_others;
    }
  }

  template <class IdType>
  static IdType to_id(std::int32_t value) {
    return value >= 0 ? IdType(value) : IdType();
  }

  /// An array of the field data with this many components, or null.
  const VtkArray* find_field(const char* array, std::size_t num_components) const {
    const auto found = grid_.field_data.find(array);
    if (found == grid_.field_data.end()) return nullptr;
    if (found->second.values.size() % num_components != 0)
      throw bad_element(name_, std::string("field array ") + array,
                        "its length is no multiple of " + std::to_string(num_components) +
                            "; the file is damaged, export it again");
    return &found->second;
  }

  /// N vertices of a row of a field array. Foreign files may use our names for anything, so they
  /// are checked like cells.
  template <std::size_t N>
  std::array<VertId, N> field_verts(const VtkArray& array, std::size_t row,
                                    const char* what) const {
    std::array<VertId, N> verts;
    for (std::size_t i = 0; i < N; ++i) {
      const double value = array.values[row * N + i];
      if (!(value >= 0 && value < static_cast<double>(file_.positions.size())))
        throw bad_element(name_, std::string("field array ") + what,
                          "row " + std::to_string(row) +
                              " uses a vertex that does not exist; export the file again");
      verts[i] = VertId(static_cast<std::int64_t>(value));
    }
    return verts;
  }

  /// Labels in the field data replace those found as cells, which are the same ones repeated.
  void read_field_data() {
    if (const VtkArray* quads = find_field(kQuads, 4)) {
      const VtkArray* patch = find_field(kQuadPatch, 1);
      file_.labels.quads.clear();
      for (std::size_t i = 0; i < quads->values.size() / 4; ++i)
        file_.labels.quads.push_back(
            {field_verts<4>(*quads, i, kQuads), to_id<PatchId>(label_at(patch, i))});
    }
    if (const VtkArray* edges = find_field(kEdges, 2)) {
      const VtkArray* curve = find_field(kEdgeCurve, 1);
      file_.labels.edges.clear();
      for (std::size_t i = 0; i < edges->values.size() / 2; ++i)
        file_.labels.edges.push_back(
            {field_verts<2>(*edges, i, kEdges), to_id<CurveId>(label_at(curve, i))});
    }
    if (const VtkArray* corners = find_field(kCorners, 1)) {
      file_.labels.corners.clear();
      for (std::size_t i = 0; i < corners->values.size(); ++i)
        file_.labels.corners.push_back(field_verts<1>(*corners, i, kCorners)[0]);
    }
    if (const VtkArray* frame = find_field("grid_frame", 4)) file_.grid_frame = frame->values;
    if (const VtkArray* s = find_field("grid_stretch", 3)) file_.grid_stretch = s->values;
    if (find_field(kNamedSets, 1)) read_names();
  }

  void read_names() {
    SetNames names;
    for (const auto& [name, array] : grid_.field_data) {
      if (array.values.size() != 2 || name == kNamedSets) continue;
      const std::int32_t number = integer_at(&array, 0), dimension = integer_at(&array, 1);
      for (SetKind kind : {SetKind::Region, SetKind::Patch, SetKind::Curve})
        if (dimension == dimension_of(kind)) names.add(kind, number, name);
    }
    names.apply(file_);
  }

  std::int32_t label_at(const VtkArray* array, std::size_t i) const {
    return array && i < array->values.size() ? integer_at(array, i) : -1;
  }

  VtkGrid grid_;
  const std::string& name_;
  VolumeFile file_;
  MidNodeReader mid_nodes_;
  const VtkArray* region_ = nullptr;
  const VtkArray* patch_ = nullptr;
  const VtkArray* curve_ = nullptr;
  std::size_t cell_ = 0;
};

VtkOutArray int_array(const char* name, std::size_t num_components) {
  VtkOutArray array;
  array.name = name;
  array.num_components = num_components;
  array.is_int = true;
  return array;
}

/// Field data belongs to the mesh as a whole: programs that do not know it carry it along
/// untouched.
void add_label_arrays(const BoundaryLabels& labels, VtkOutput& out) {
  if (!labels.quads.empty()) {
    VtkOutArray quads = int_array(kQuads, 4), patch = int_array(kQuadPatch, 1);
    for (const LabeledQuad& quad : labels.quads) {
      for (VertId v : quad.verts) quads.ints.push_back(v.value());
      patch.ints.push_back(quad.patch.value());
    }
    out.field_data.push_back(std::move(quads));
    out.field_data.push_back(std::move(patch));
  }
  if (!labels.edges.empty()) {
    VtkOutArray edges = int_array(kEdges, 2), curve = int_array(kEdgeCurve, 1);
    for (const LabeledEdge& edge : labels.edges) {
      for (VertId v : edge.verts) edges.ints.push_back(v.value());
      curve.ints.push_back(edge.curve.value());
    }
    out.field_data.push_back(std::move(edges));
    out.field_data.push_back(std::move(curve));
  }
  if (!labels.corners.empty()) {
    VtkOutArray corners = int_array(kCorners, 1);
    for (VertId v : labels.corners) corners.ints.push_back(v.value());
    out.field_data.push_back(std::move(corners));
  }
}

/// Sets with a name of their own.
void add_names(const SetTable& table, VtkOutput& out) {
  std::vector<VtkOutArray> names;
  for (const auto* sets : {&table.regions, &table.patches, &table.curves})
    for (const NamedSet& set : *sets) {
      if (set.number < 0 || !set.is_given) continue;
      names.push_back(int_array(set.name.c_str(), 1));
      names.back().ints = {set.number, dimension_of(set.kind)};
    }
  if (names.empty()) return;
  VtkOutArray count = int_array(kNamedSets, 1);
  count.ints = {static_cast<std::int32_t>(names.size())};
  out.field_data.push_back(std::move(count));
  for (VtkOutArray& name : names) out.field_data.push_back(std::move(name));
}

/// Our local order of all kinds is that of VTK.
template <class Verts>
void add_out_cell(const Verts& verts, VtkCellType type, VtkOutput& out) {
  for (VertId v : verts) out.connectivity.push_back(v.value());
  out.ends.push_back(static_cast<std::int32_t>(out.connectivity.size()));
  out.types.push_back(static_cast<std::uint8_t>(type));
}

/// Quads, edges and corners as cells after the hexes, with their numbers as cell data; cells of
/// another kind get -1.
void add_set_cells(const NodeTable& nodes, VtkOutput& out) {
  const HexMesh& mesh = nodes.mesh();
  const VtkTypes types = vtk_types(nodes.nodes_per_hex());
  VtkOutArray patch = int_array("patch", 1), curve = int_array("curve", 1);
  patch.ints.assign(mesh.num_hexes(), -1);
  curve.ints.assign(mesh.num_hexes(), -1);
  const auto add = [&](std::int32_t patch_value, std::int32_t curve_value) {
    patch.ints.push_back(patch_value);
    curve.ints.push_back(curve_value);
  };
  for (const LabeledQuad& quad : mesh.labels.quads) {
    add_out_cell(nodes.quad(quad.verts), types.quad, out);
    add(quad.patch.value(), -1);
  }
  for (const LabeledEdge& edge : mesh.labels.edges) {
    add_out_cell(nodes.edge(edge.verts), types.line, out);
    add(-1, edge.curve.value());
  }
  for (VertId v : mesh.labels.corners) {
    add_out_cell(std::array{v}, VtkVertex, out);
    add(-1, -1);
  }
  out.cell_data.push_back(std::move(patch));
  out.cell_data.push_back(std::move(curve));
}

/// Cells behind the hexes get values that say "none": region -1, not a number elsewhere.
void add_cell_fields(const HexMesh& mesh, const WriteHexOptions& options, VtkOutput& out) {
  if (!mesh.region.empty()) {
    VtkOutArray region = int_array("region", 1);
    region.ints = mesh.region.raw();
    region.ints.resize(out.ends.size(), -1);
    out.cell_data.push_back(std::move(region));
  }
  for (const HexField& field : options.fields) {
    VtkOutArray array;
    array.name = field.name;
    array.reals = field.values;
    array.reals.resize(out.ends.size(), std::numeric_limits<double>::quiet_NaN());
    out.cell_data.push_back(std::move(array));
  }
}

}  // namespace

/// Letters that neither XML nor the legacy format's words would have to escape.
NameRules vtk_names() {
  NameRules rules;
  rules.is_allowed = is_word_letter_or_mark;
  rules.reserved = {kQuads,   kQuadPatch, kEdges,       kEdgeCurve,
                    kCorners, kNamedSets, "grid_frame", "grid_stretch"};
  return rules;
}

VolumeFile to_volume_file(VtkGrid&& grid, const std::string& file_name) {
  return VtkConverter(std::move(grid), file_name).run();
}

/// The same content for the legacy and the XML format. `feature` on the points is for looking at;
/// what is read back are the field arrays.
VtkOutput make_vtk_output(const NodeTable& nodes, const SetTable& table,
                          const WriteHexOptions& options) {
  const HexMesh& mesh = nodes.mesh();
  VtkOutput out;
  out.connectivity.reserve(static_cast<std::size_t>(nodes.nodes_per_hex()) * mesh.num_hexes());
  out.ends.reserve(mesh.num_hexes());
  out.types.reserve(mesh.num_hexes());
  const VtkCellType type = vtk_types(nodes.nodes_per_hex()).hex;
  for (HexId h : mesh.hexes.ids()) add_out_cell(nodes.hex(h), type, out);
  if (options.write_sets) add_set_cells(nodes, out);
  add_cell_fields(mesh, options, out);
  const BoundaryLabels& labels = mesh.labels;
  if (!labels.quads.empty() || !labels.edges.empty() || !labels.corners.empty()) {
    const auto flags = compute_feature_flags(nodes);
    VtkOutArray feature = int_array("feature", 1);
    feature.ints.assign(flags.begin(), flags.end());
    out.point_data.push_back(std::move(feature));
  }
  add_label_arrays(labels, out);
  add_names(table, out);
  return out;
}

}  // namespace hexwright::io
