// Writes MED 4 files (.med), which Salome and code_aster read, without the libraries.
//
// A region, patch, curve or the corners is a group of elements; an element belongs to one family,
// whose groups are the set's name and, of a patch such as "wall.1", also "wall". Arrays hold the
// first node of all elements, then the second of all, and so on.
//
// Based on: EDF, CEA, "MED file format" (documentation of MED 4.1), and the files that its library
// writes. Hexes are counted the other way round than VTK's: 0 3 2 1 4 7 6 5.
#include <fmt/format.h>

#include "hexwright/base/cancel.h"

#include "io/solver/solver_formats.h"
#include "io/text/hdf5_writer.h"

namespace hexwright::io {
namespace {

constexpr std::size_t kNameLength = 80;
constexpr const char* kMesh = "mesh";
constexpr const char* kStep = "-0000000000000000001-0000000000000000001";

constexpr std::array<std::size_t, 20> kHexOrder = {0, 3, 2,  1,  4,  7,  6,  5,  11, 10,
                                                   9, 8, 15, 14, 13, 12, 16, 19, 18, 17};

using Ints = std::vector<std::int32_t>;

/// All elements of one shape: their nodes, one element after the other, and families.
struct Elements {
  Ints nodes, families;
  std::size_t size = 0;  ///< nodes of one
};

class MedWriter {
 public:
  MedWriter(const NodeTable& nodes, const SetTable& table) : nodes_(nodes), table_(table) {}

  std::string run() {
    Hdf5Node& info = root_.child("INFOS_GENERALES");
    info.attribute("MAJ", hdf5_int(4));
    info.attribute("MIN", hdf5_int(0));
    info.attribute("REL", hdf5_int(0));
    Hdf5Node& step = write_mesh().child(kStep);
    step.attribute("CGT", hdf5_int(1));
    step.attribute("NDT", hdf5_int(-1));
    step.attribute("NOR", hdf5_int(-1));
    step.attribute("PDT", hdf5_double(-1));
    write_nodes(step.child("NOE"));
    write_families(root_.child("FAS").child(kMesh), step.child("MAI"));
    return root_.file();
  }

 private:
  Hdf5Node& write_mesh() {
    Hdf5Node& mesh = root_.child("ENS_MAA").child(kMesh);
    for (const auto& [name, value] :
         {std::pair{"DIM", 3}, {"ESP", 3}, {"REP", 0}, {"SRT", 0}, {"TYP", 0}})
      mesh.attribute(name, hdf5_int(value));
    std::string axes;
    for (const char* axis : {"X", "Y", "Z"}) axes += fmt::format("{:<16}", axis);
    mesh.attribute("NOM", hdf5_text(axes, 3 * 16 + 1));
    mesh.attribute("UNI", hdf5_text("", 3 * 16 + 1));
    mesh.attribute("UNT", hdf5_text("", 17));
    mesh.attribute("DES", hdf5_text("hexwright", 201));
    return mesh;
  }

  static void describe(Hdf5Node& node) {
    node.attribute("CGT", hdf5_int(1));
    node.attribute("CGS", hdf5_int(1));
    node.attribute("PFL", hdf5_text("MED_NO_PROFILE_INTERNAL", 65));
  }
  static void add(Hdf5Node& parent, const char* name, Hdf5Array array, std::size_t count) {
    Hdf5Node& node = parent.dataset(name, std::move(array));
    node.attribute("CGT", hdf5_int(1));
    node.attribute("NBR", hdf5_int(static_cast<std::int32_t>(count)));
  }

  void write_nodes(Hdf5Node& group) {
    describe(group);
    std::vector<double> values;
    for (int axis = 0; axis < 3; ++axis)
      for (const Vec3& p : nodes_.positions()) values.push_back(p[axis]);
    add(group, "COO", hdf5_doubles(values, {values.size()}), nodes_.size());
    const Ints families(nodes_.size(), 0);
    add(group, "FAM", hdf5_ints(families, {families.size()}), nodes_.size());
  }

  /// A patch such as "wall.1" belongs to "wall" too.
  std::vector<std::string> groups_of(const NamedSet& set) const {
    std::vector<std::string> groups{set.name};
    if (set.kind == SetKind::Patch)
      for (const NamedSet& group : table_.patch_groups)
        if (is_in_group(set, group)) groups.push_back(group.name);
    return groups;
  }

  /// Counted downwards from -1; 0 is that of elements without a group.
  std::int32_t add_family(Hdf5Node& families, const std::vector<std::string>& groups) {
    const std::int32_t number = --last_family_;
    Hdf5Node& family =
        families.child("ELEME").child(fmt::format("FAM_{}_{}", number, groups[0]).substr(0, 64));
    family.attribute("NUM", hdf5_int(number));
    Hdf5Node& names = family.child("GRO");
    names.attribute("NBR", hdf5_int(static_cast<std::int32_t>(groups.size())));
    names.dataset("NOM", hdf5_text_rows(groups, kNameLength));
    return number;
  }

  void write_families(Hdf5Node& families, Hdf5Node& elements) {
    families.child("FAMILLE_ZERO").attribute("NUM", hdf5_int(0));
    elements.attribute("CGT", hdf5_int(1));
    const bool is_linear = nodes_.is_linear();
    write(elements, "PO1", gather(families, table_.corners));
    write(elements, is_linear ? "SE2" : "SE3", gather(families, table_.curves));
    write(elements, is_linear ? "QU4" : "QU8", gather(families, table_.patches));
    write(elements, is_linear ? "HE8" : "H20", gather(families, table_.regions));
  }

  /// All elements of sets of one kind, a family for each set.
  Elements gather(Hdf5Node& families, const std::vector<NamedSet>& sets) {
    Elements elements;
    CancelCheck check_cancelled;
    for (const NamedSet& set : sets) {
      const std::int32_t family = add_family(families, groups_of(set));
      for (std::size_t i : set.members) {
        check_cancelled();
        const NodeList list = nodes_.element(set.kind, i);
        elements.size = list.size();
        elements.families.push_back(family);
        for (std::size_t k = 0; k < list.size(); ++k)
          elements.nodes.push_back(list[set.kind == SetKind::Region ? kHexOrder[k] : k].value() +
                                   1);
      }
    }
    return elements;
  }

  static void write(Hdf5Node& parent, const char* shape, const Elements& elements) {
    const std::size_t count = elements.families.size();
    if (count == 0) return;
    Ints by_node;
    for (std::size_t k = 0; k < elements.size; ++k)
      for (std::size_t i = 0; i < count; ++i)
        by_node.push_back(elements.nodes[i * elements.size + k]);
    Hdf5Node& group = parent.child(shape);
    describe(group);
    add(group, "NOD", hdf5_ints(by_node, {by_node.size()}), count);
    add(group, "FAM", hdf5_ints(elements.families, {count}), count);
  }

  const NodeTable& nodes_;
  const SetTable& table_;
  Hdf5Node root_;
  std::int32_t last_family_ = 0;
};

}  // namespace

NameRules med_names() {
  NameRules rules;
  rules.max_length = kNameLength;
  rules.is_allowed = [](char c) { return c != '/'; };
  return rules;
}

std::string med_bytes(const NodeTable& nodes, const SetTable& table) {
  return MedWriter(nodes, table).run();
}

}  // namespace hexwright::io
