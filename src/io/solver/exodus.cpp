// Writes Exodus II files (.exo): element blocks, side sets and node sets, with names.
//
// A region is an element block; a patch is a side set and, with the same number and name, a node
// set; curves and corners are node sets. Elements stand block by block; elem_num_map keeps their
// numbers.
//
// Based on: Schoof, Yarberry, "EXODUS II: A Finite Element Data Model", SAND92-2137 (updated 2013),
// which lays the model out in a netCDF file; sides of HEX elements by its table.
#include <fmt/format.h>

#include "io/solver/solver_formats.h"
#include "io/text/netcdf_writer.h"

namespace hexwright::io {
namespace {

constexpr std::size_t kNameLength = 32;

// Side 1 to 6 of a HEX for each of our local faces -x +x -y +y -z +z: side 1 is nodes 1-2-6-5,
// 2 2-3-7-6, 3 3-4-8-7, 4 1-5-8-4, 5 1-4-3-2, 6 5-6-7-8.
constexpr std::array<std::int32_t, 6> kExodusSide = {4, 2, 1, 3, 5, 6};

using Sets = std::vector<const NamedSet*>;

class ExodusWriter {
 public:
  ExodusWriter(const NodeTable& nodes, const SetTable& table)
      : nodes_(nodes),
        mesh_(nodes.mesh()),
        sides_(find_quad_sides(mesh_)),
        hex_to_element_(mesh_.num_hexes()) {
    for (const NamedSet& set : table.regions) blocks_.push_back(&set);
    for (const auto* sets : {&table.patches, &table.patch_groups})
      for (const NamedSet& set : *sets) side_sets_.push_back(&set);
    node_sets_ = side_sets_;
    for (const auto* sets : {&table.curves, &table.corners})
      for (const NamedSet& set : *sets) node_sets_.push_back(&set);
  }

  std::string run() {
    write_globals();
    write_coordinates();
    write_blocks();
    if (!side_sets_.empty()) write_side_sets();
    if (!node_sets_.empty()) write_node_sets();
    out_.record_doubles("time_whole", out_.dimension("time_step", 0));
    return out_.take();
  }

 private:
  void write_globals() {
    out_.text_attribute("title", "hexwright");
    out_.float_attribute("api_version", 8.03f);
    out_.float_attribute("version", 8.03f);
    out_.int_attribute("floating_point_word_size", 8);
    out_.int_attribute("file_size", 1);
    out_.int_attribute("maximum_name_length", kNameLength);
    out_.int_attribute("int64_status", 0);
    name_length_ = out_.dimension("len_name", kNameLength + 1);
  }

  void write_coordinates() {
    const auto num_dim = out_.dimension("num_dim", 3);
    const auto num_nodes = out_.dimension("num_nodes", nodes_.size());
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (const Vec3& p : nodes_.positions()) values.push_back(p[axis]);
      out_.doubles(fmt::format("coord{}", "xyz"[axis]), {num_nodes}, values);
    }
    out_.texts("coor_names", {num_dim, name_length_}, {"x", "y", "z"}, kNameLength + 1);
  }

  /// Status, numbers and names of all sets of a kind, which its prefix names.
  void write_list(const Sets& sets, const std::string& prefix, const char* dimension) {
    const auto count = out_.dimension(dimension, sets.size());
    std::vector<std::int32_t> ids;
    std::vector<std::string> names;
    for (const NamedSet* set : sets) {
      ids.push_back(static_cast<std::int32_t>(ids.size()) + 1);
      names.push_back(set->name);
    }
    const std::vector<std::int32_t> status(sets.size(), 1);
    out_.ints(prefix + "_status", {count}, status);
    out_.ints(prefix + "_prop1", {count}, ids, {"name", "ID"});
    out_.texts(prefix + "_names", {count, name_length_}, names, kNameLength + 1);
  }

  void write_blocks() {
    const auto num_elements = out_.dimension("num_elem", mesh_.num_hexes());
    write_list(blocks_, "eb", "num_el_blk");
    std::vector<std::int32_t> numbers;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      std::vector<std::int32_t> connectivity;
      for (std::size_t h : blocks_[b]->members) {
        numbers.push_back(static_cast<std::int32_t>(h) + 1);
        hex_to_element_[HexId(h)] = static_cast<std::int32_t>(numbers.size());
        const NodeList list = nodes_.hex(HexId(h));
        for (std::size_t k = 0; k < list.size(); ++k)
          connectivity.push_back(list[kUprightEdgesFirst[k]].value() + 1);
      }
      const auto count =
          out_.dimension(fmt::format("num_el_in_blk{}", b + 1), blocks_[b]->members.size());
      const auto width = out_.dimension(fmt::format("num_nod_per_el{}", b + 1),
                                        static_cast<std::size_t>(nodes_.nodes_per_hex()));
      out_.ints(fmt::format("connect{}", b + 1), {count, width}, connectivity,
                {"elem_type", nodes_.is_linear() ? "HEX8" : "HEX20"});
    }
    out_.ints("elem_num_map", {num_elements}, numbers);
  }

  void write_side_sets() {
    write_list(side_sets_, "ss", "num_side_sets");
    for (std::size_t s = 0; s < side_sets_.size(); ++s) {
      std::vector<std::int32_t> elements, sides;
      for (std::size_t q : side_sets_[s]->members) {
        elements.push_back(hex_to_element_[sides_[q].hex]);
        sides.push_back(kExodusSide[static_cast<std::size_t>(sides_[q].lf)]);
      }
      const auto count = out_.dimension(fmt::format("num_side_ss{}", s + 1), elements.size());
      out_.ints(fmt::format("elem_ss{}", s + 1), {count}, elements);
      out_.ints(fmt::format("side_ss{}", s + 1), {count}, sides);
    }
  }

  void write_node_sets() {
    write_list(node_sets_, "ns", "num_node_sets");
    for (std::size_t s = 0; s < node_sets_.size(); ++s) {
      std::vector<std::int32_t> nodes;
      for (VertId v : nodes_.set_nodes(*node_sets_[s])) nodes.push_back(v.value() + 1);
      const auto count = out_.dimension(fmt::format("num_nod_ns{}", s + 1), nodes.size());
      out_.ints(fmt::format("node_ns{}", s + 1), {count}, nodes);
    }
  }

  const NodeTable& nodes_;
  const HexMesh& mesh_;
  Sets blocks_, side_sets_, node_sets_;
  std::vector<HexFace> sides_;
  IdVector<HexId, std::int32_t> hex_to_element_;
  NetcdfWriter out_;
  std::int32_t name_length_ = 0;
};

}  // namespace

NameRules exodus_names() {
  NameRules rules;
  rules.max_length = kNameLength;
  rules.is_allowed = is_word_letter_or_mark;
  return rules;
}

std::string exodus_bytes(const NodeTable& nodes, const SetTable& table) {
  return ExodusWriter(nodes, table).run();
}

}  // namespace hexwright::io
