// Writes VTKHDF files (.vtkhdf) without the library: a collection of grids, each with points of its
// own, for each region, patch, curve and the corners, under their names.
//
// Based on: Kitware, "VTKHDF File Format", version 2.1 (VTK 9.3): PartitionedDataSetCollection.
#include <map>

#include "io/solver/solver_formats.h"
#include "io/text/hdf5_writer.h"

namespace hexwright::io {
namespace {

enum CellType : char {
  Vertex = 1,
  Line = 3,
  Quad = 9,
  Hexahedron = 12,
  QuadraticEdge = 21,
  QuadraticQuad = 23,
  QuadraticHexahedron = 25,
  BiquadraticQuad = 28,
  TriquadraticHexahedron = 29
};

class VtkhdfWriter {
 public:
  VtkhdfWriter(const NodeTable& nodes, const SetTable& table)
      : nodes_(nodes), mesh_(nodes.mesh()), table_(table), top_(root_.child("VTKHDF")) {}

  std::string run(const std::vector<HexField>& fields) {
    describe(top_, "PartitionedDataSetCollection");
    for (const NamedSet& set : table_.regions) write_region(set, fields);
    for (const NamedSet& set : table_.patches)
      write_set(set, [&](std::size_t q) { return nodes_.quad(mesh_.labels.quads[q].verts); });
    for (const NamedSet& set : table_.curves)
      write_set(set, [&](std::size_t e) { return nodes_.edge(mesh_.labels.edges[e].verts); });
    for (const NamedSet& set : table_.corners)
      write_set(set, [&](std::size_t c) {
        NodeList list;
        list.push_back(mesh_.labels.corners[c]);
        return list;
      });
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

  static char type_of(SetKind kind, std::size_t size) {
    switch (kind) {
      case SetKind::Region:
        return size == 8 ? Hexahedron : size == 20 ? QuadraticHexahedron : TriquadraticHexahedron;
      case SetKind::Curve:
        return size == 2 ? Line : QuadraticEdge;
      case SetKind::Corners:
        return Vertex;
      default:
        return size == 4 ? Quad : size == 8 ? QuadraticQuad : BiquadraticQuad;
    }
  }

  static void write_cells(Hdf5Node& grid, const std::vector<Vec3>& points,
                          const std::vector<std::int64_t>& nodes, std::size_t size, char type) {
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
    grid.dataset("Types", hdf5_bytes(std::string(count, type), false));
  }

  void write_region(const NamedSet& set, const std::vector<HexField>& fields) {
    Hdf5Node& grid = write_set(set, [&](std::size_t h) { return nodes_.hex(HexId(h)); });
    const std::vector<std::int32_t> numbers(set.members.size(), set.number);
    Hdf5Node& data = grid.child("CellData");
    data.dataset("region", hdf5_ints(numbers, {numbers.size()}));
    for (const HexField& field : fields) {
      std::vector<double> values;
      for (std::size_t h : set.members) values.push_back(field.values[h]);
      data.dataset(field.name, hdf5_doubles(values, {values.size()}));
    }
  }

  template <class Nodes>
  Hdf5Node& write_set(const NamedSet& set, Nodes&& nodes_of) {
    std::map<VertId, std::int64_t> number;
    std::vector<Vec3> points;
    for (VertId v : nodes_.set_nodes(set)) {
      number[v] = static_cast<std::int64_t>(points.size());
      points.push_back(nodes_.positions()[v]);
    }
    std::vector<std::int64_t> nodes;
    std::size_t size = 1;
    for (std::size_t i : set.members) {
      const NodeList list = nodes_of(i);
      size = list.size();
      for (VertId v : list) nodes.push_back(number.at(v));
    }
    Hdf5Node& grid = add_grid(set.name);
    write_cells(grid, points, nodes, size, type_of(set.kind, size));
    return grid;
  }

  const NodeTable& nodes_;
  const HexMesh& mesh_;
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
