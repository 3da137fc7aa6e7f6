// Writes VTKHDF files (.vtkhdf) without the library: a collection of grids, each with points of its
// own, for each region, patch, curve and the corners, under their names.
//
// Based on: Kitware, "VTKHDF File Format", version 2.1 (VTK 9.3): PartitionedDataSetCollection.
#include <algorithm>

#include "hexwright/base/cancel.h"

#include "io/solver/solver_formats.h"
#include "io/text/hdf5_writer.h"
#include "io/vtk/vtk_types.h"

namespace hexwright::io {
namespace {

class VtkhdfWriter {
 public:
  VtkhdfWriter(const NodeTable& nodes, const SetTable& table)
      : nodes_(nodes), table_(table), top_(root_.child("VTKHDF")) {}

  std::string run(const std::vector<HexField>& fields) {
    describe(top_, "PartitionedDataSetCollection");
    for (const NamedSet& set : table_.regions) write_fields(write_set(set), set, fields);
    for (const auto* sets : {&table_.patches, &table_.curves, &table_.corners})
      for (const NamedSet& set : *sets) write_set(set);
    Hdf5Node& assembly = top_.child("Assembly");
    for (const std::string& name : names_) assembly.soft_link(name, "/VTKHDF/" + name);
    return root_.file();
  }

 private:
  static void describe(Hdf5Node& node, const char* type) {
    const std::array<std::int64_t, 2> version = {2, 1};
    node.attribute("Version", hdf5_longs(version, {2}));
    node.attribute("Type", hdf5_text(type));
  }

  Hdf5Node& add_grid(const std::string& name) {
    Hdf5Node& grid = top_.child(name);
    describe(grid, "UnstructuredGrid");
    grid.attribute("Index", hdf5_int(static_cast<std::int32_t>(names_.size())));
    names_.push_back(name);
    return grid;
  }

  VtkCellType type_of(SetKind kind) const {
    const VtkTypes types = vtk_types(nodes_.nodes_per_hex());
    switch (kind) {
      case SetKind::Region:
        return types.hex;
      case SetKind::Curve:
        return types.line;
      case SetKind::Corners:
        return VtkVertex;
      default:
        return types.quad;
    }
  }

  static void write_cells(Hdf5Node& grid, const std::vector<Vec3>& points,
                          const std::vector<std::int64_t>& nodes, std::size_t size,
                          VtkCellType type) {
    const std::size_t count = nodes.size() / size;
    std::vector<std::int64_t> offsets;
    for (std::size_t i = 0; i <= count; ++i) offsets.push_back(static_cast<std::int64_t>(i * size));
    std::vector<double> coordinates;
    for (const Vec3& p : points)
      for (int axis = 0; axis < 3; ++axis) coordinates.push_back(p[axis]);
    const auto put = [&](const char* name, std::size_t value) {
      const auto number = static_cast<std::int64_t>(value);
      grid.dataset(name, hdf5_longs({&number, 1}, {1}));
    };
    put("NumberOfPoints", points.size());
    put("NumberOfCells", count);
    put("NumberOfConnectivityIds", nodes.size());
    grid.dataset("Points", hdf5_doubles(coordinates, {points.size(), 3}));
    grid.dataset("Connectivity", hdf5_longs(nodes, {nodes.size()}));
    grid.dataset("Offsets", hdf5_longs(offsets, {offsets.size()}));
    grid.dataset("Types", hdf5_bytes(std::string(count, static_cast<char>(type)), false));
  }

  static void write_fields(Hdf5Node& grid, const NamedSet& set,
                           const std::vector<HexField>& fields) {
    const std::vector<std::int32_t> numbers(set.members.size(), set.number);
    Hdf5Node& data = grid.child("CellData");
    data.dataset("region", hdf5_ints(numbers, {numbers.size()}));
    for (const HexField& field : fields) {
      std::vector<double> values;
      for (std::size_t h : set.members) values.push_back(field.values[h]);
      data.dataset(field.name, hdf5_doubles(values, {values.size()}));
    }
  }

  Hdf5Node& write_set(const NamedSet& set) {
    const std::vector<VertId> verts = nodes_.set_nodes(set);
    std::vector<Vec3> points;
    for (VertId v : verts) points.push_back(nodes_.positions()[v]);
    std::vector<std::int64_t> nodes;
    std::size_t size = 1;
    CancelCheck check_cancelled;
    for (std::size_t i : set.members) {
      check_cancelled();
      const NodeList list = nodes_.element(set.kind, i);
      size = list.size();
      for (VertId v : list)
        nodes.push_back(std::lower_bound(verts.begin(), verts.end(), v) - verts.begin());
    }
    Hdf5Node& grid = add_grid(set.name);
    write_cells(grid, points, nodes, size, type_of(set.kind));
    return grid;
  }

  const NodeTable& nodes_;
  const SetTable& table_;
  Hdf5Node root_;
  Hdf5Node& top_;
  std::vector<std::string> names_;
};

}  // namespace

NameRules vtkhdf_names() {
  NameRules rules;
  rules.is_allowed = is_word_letter_or_mark;
  rules.starts_with_letter = true;
  rules.reserved = {"Assembly"};
  return rules;
}

std::string vtkhdf_bytes(const NodeTable& nodes, const SetTable& table,
                         const WriteHexOptions& options) {
  return VtkhdfWriter(nodes, table).run(options.fields);
}

}  // namespace hexwright::io
