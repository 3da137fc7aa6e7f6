// Writes CGNS files (.cgns) in their HDF5 form, without the libraries.
//
// One base with one unstructured zone: a section of elements per region and per patch; a boundary
// condition per patch (its elements), curve and corners (their vertices), of type FamilySpecified,
// with a family of the same name.
//
// Based on: CGNS Steering Committee, "Standard Interface Data Structures" 3.4 (elements and their
// node orders) and "HDF5 Implementation" (a node is a group with attributes and data of type I4,
// R8, C1 or MT; lengths stand in the opposite order).
#include <fmt/format.h>

#include "hexwright/base/cancel.h"

#include "io/solver/solver_formats.h"
#include "io/text/hdf5_writer.h"

namespace hexwright::io {
namespace {

constexpr std::size_t kNameLength = 32;

// Faces 20 to 25 are -z -y +x +y -x +z there.
constexpr std::array<std::size_t, 7> kInnerOrder = {24, 22, 21, 23, 20, 25, 26};

enum ElementType { Quad4 = 7, Quad8, Quad9, Hexa8 = 17, Hexa20, Hexa27 };

using Ints = std::vector<std::int32_t>;

class CgnsWriter {
 public:
  CgnsWriter(const NodeTable& nodes, const SetTable& table) : nodes_(nodes), table_(table) {}

  std::string run() {
    write_root();
    const float version = 3.4f;
    add(root_, "CGNSLibraryVersion", "CGNSLibraryVersion_t", "R4", hdf5_floats({&version, 1}));
    Hdf5Node& base = add_ints(root_, "Base", "CGNSBase_t", {3, 3}, {2});
    for (const auto* sets : {&table_.patches, &table_.curves, &table_.corners})
      for (const NamedSet& set : *sets)
        add_text(add(base, set.name, "Family_t"), "FamBC", "FamilyBC_t", "UserDefined");
    const auto num_hexes = static_cast<std::int32_t>(nodes_.mesh().num_hexes());
    Hdf5Node& zone = add_ints(base, "Zone", "Zone_t",
                              {static_cast<std::int32_t>(nodes_.size()), num_hexes, 0}, {3, 1});
    add_text(zone, "ZoneType", "ZoneType_t", "Unstructured");
    write_coordinates(zone);
    for (const NamedSet& set : table_.regions) write_hexes(zone, set);
    Hdf5Node& conditions = add(zone, "ZoneBC", "ZoneBC_t");
    for (const NamedSet& set : table_.patches) write_patch(zone, conditions, set);
    for (const auto* sets : {&table_.curves, &table_.corners})
      for (const NamedSet& set : *sets) write_points(conditions, set);
    return root_.file();
  }

 private:
  static void describe(Hdf5Node& node, const std::string& name, const std::string& label,
                       const std::string& type) {
    node.attribute("name", hdf5_text(name, kNameLength + 1));
    node.attribute("label", hdf5_text(label, kNameLength + 1));
    node.attribute("type", hdf5_text(type, 3));
  }
  static Hdf5Node& add(Hdf5Node& parent, const std::string& name, const std::string& label,
                       const std::string& type = "MT") {
    Hdf5Node& node = parent.child(name);
    describe(node, name, label, type);
    node.attribute("flags", hdf5_ints(std::array{1}, {1}));
    return node;
  }
  static Hdf5Node& add(Hdf5Node& parent, const std::string& name, const std::string& label,
                       const std::string& type, Hdf5Array data) {
    Hdf5Node& node = add(parent, name, label, type);
    node.dataset(" data", std::move(data));
    return node;
  }
  static Hdf5Node& add_ints(Hdf5Node& parent, const std::string& name, const std::string& label,
                            const Ints& values, std::vector<std::uint64_t> lengths) {
    return add(parent, name, label, "I4", hdf5_ints(values, std::move(lengths)));
  }
  static Hdf5Node& add_text(Hdf5Node& parent, const std::string& name, const std::string& label,
                            const std::string& text) {
    return add(parent, name, label, "C1", hdf5_bytes(text, true));
  }

  void write_root() {
    describe(root_, "HDF5 MotherNode", "Root Node of HDF5 File", "MT");
    const auto filled = [](std::string text) {
      text.resize(kNameLength + 1);
      return hdf5_bytes(text, true);
    };
    root_.dataset(" format", filled("IEEE_LITTLE_32"));
    root_.dataset(" hdf5version", filled("HDF5 Version 1.8.0"));
  }

  void write_coordinates(Hdf5Node& zone) {
    Hdf5Node& coordinates = add(zone, "GridCoordinates", "GridCoordinates_t");
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (const Vec3& p : nodes_.positions()) values.push_back(p[axis]);
      add(coordinates, fmt::format("Coordinate{}", "XYZ"[axis]), "DataArray_t", "R8",
          hdf5_doubles(values, {values.size()}));
    }
  }

  /// Elements are numbered on from section to section.
  void write_section(Hdf5Node& zone, const std::string& name, std::int32_t type, const Ints& nodes,
                     std::size_t count) {
    Hdf5Node& section = add_ints(zone, name, "Elements_t", {type, 0}, {2});
    const std::int32_t first = num_elements_ + 1;
    num_elements_ += static_cast<std::int32_t>(count);
    add_ints(section, "ElementRange", "IndexRange_t", {first, num_elements_}, {2});
    add_ints(section, "ElementConnectivity", "DataArray_t", nodes, {nodes.size()});
  }

  void write_hexes(Hdf5Node& zone, const NamedSet& set) {
    const auto size = static_cast<std::size_t>(nodes_.nodes_per_hex());
    Ints nodes;
    CancelCheck check_cancelled;
    for (std::size_t h : set.members) {
      check_cancelled();
      const NodeList list = nodes_.hex(HexId(h));
      for (std::size_t k = 0; k < size; ++k)
        nodes.push_back(list[k < 20 ? kUprightEdgesFirst[k] : kInnerOrder[k - 20]].value() + 1);
    }
    write_section(zone, set.name,
                  size == 8    ? Hexa8
                  : size == 20 ? Hexa20
                               : Hexa27,
                  nodes, set.members.size());
  }

  void write_patch(Hdf5Node& zone, Hdf5Node& conditions, const NamedSet& set) {
    Ints nodes;
    std::size_t size = 4;
    CancelCheck check_cancelled;
    for (std::size_t q : set.members) {
      check_cancelled();
      const NodeList list = nodes_.quad(nodes_.mesh().labels.quads[q].verts);
      size = list.size();
      for (VertId v : list) nodes.push_back(v.value() + 1);
    }
    const std::int32_t first = num_elements_ + 1;
    write_section(zone, set.name,
                  size == 4   ? Quad4
                  : size == 8 ? Quad8
                              : Quad9,
                  nodes, set.members.size());
    Hdf5Node& condition = add_condition(conditions, set.name, "FaceCenter");
    add_ints(condition, "PointRange", "IndexRange_t", {first, num_elements_}, {2, 1});
  }

  void write_points(Hdf5Node& conditions, const NamedSet& set) {
    Ints points;
    for (VertId v : nodes_.set_nodes(set)) points.push_back(v.value() + 1);
    Hdf5Node& condition = add_condition(conditions, set.name, "Vertex");
    add_ints(condition, "PointList", "IndexArray_t", points, {points.size(), 1});
  }

  Hdf5Node& add_condition(Hdf5Node& conditions, const std::string& name, const char* location) {
    Hdf5Node& condition = add_text(conditions, name, "BC_t", "FamilySpecified");
    add_text(condition, "GridLocation", "GridLocation_t", location);
    add_text(condition, "FamilyName", "FamilyName_t", name);
    return condition;
  }

  const NodeTable& nodes_;
  const SetTable& table_;
  Hdf5Node root_;
  std::int32_t num_elements_ = 0;
};

}  // namespace

NameRules cgns_names() {
  NameRules rules;
  rules.max_length = kNameLength;
  rules.is_allowed = is_word_letter_or_mark;
  rules.reserved = {".", "Zone", "ZoneType", "ZoneBC", "GridCoordinates"};
  return rules;
}

std::string cgns_bytes(const NodeTable& nodes, const SetTable& table) {
  return CgnsWriter(nodes, table).run();
}

}  // namespace hexwright::io
