// Reads Gmsh files in text form, versions 2.x and 4.1: hexes, tets, quads, lines and points, with
// their physical groups (the first one of each entity), or their elementary entities where there
// are no groups.
//
// Based on: Geuzaine, Remacle, "Gmsh reference manual", section "MSH file format".
// Differs: elements of other kinds, and tets of second order, are counted and left out.
#include <algorithm>
#include <array>
#include <unordered_map>

#include "io/mesh/foreign_labels.h"
#include "io/mesh/gmsh_order.h"
#include "io/mesh/read_mid_nodes.h"
#include "io/mesh/set_names.h"
#include "io/surface/polygon_soup.h"
#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"

namespace hexwright::io {
namespace {

// Gmsh's element types.
enum GmshType : std::int64_t {
  Line = 1,
  Quad = 3,
  Tetra = 4,
  Hexahedron = 5,
  Line3 = 8,
  Quad9 = 10,
  Hexahedron27 = 12,
  Point = 15,
  Quad8 = 16,
  Hexahedron20 = 17
};

/// What an element belongs to: its physical group, or its entity where it is in none.
struct GmshGroup {
  std::int64_t tag = 0;
  bool is_physical = false;
};

class GmshReader {
 public:
  explicit GmshReader(const VolumeSource& source)
      : scanner_(source.bytes, source.name), name_(source.name) {}

  VolumeFile run() {
    while (scanner_.skip_blank()) {
      const std::string section(scanner_.line_token());
      scanner_.next_line();
      read_section(section);
    }
    number_groups();
    mid_nodes_.settle(file_, name_);
    settle_labels(file_);
    names_.apply(file_);
    return std::move(file_);
  }

 private:
  void read_section(const std::string& section) {
    if (section == "$MeshFormat")
      read_format();
    else if (section == "$PhysicalNames")
      read_names();
    else if (section == "$Entities")
      read_entities();
    else if (section == "$Nodes")
      is_version_4_ ? read_nodes_4() : read_nodes_2();
    else if (section == "$Elements")
      is_version_4_ ? read_elements_4() : read_elements_2();
    skip_to_end(section);
  }

  void read_format() {
    const double version = scanner_.real("the format's version");
    if (!(version >= 2 && version < 3) && version != 4.1)
      scanner_.fail("version " + std::to_string(version) +
                    " of the format is not supported; save the mesh as version 4.1 or 2.2");
    is_version_4_ = version > 4;
    if (scanner_.integer("the file's type") != 0)
      scanner_.fail("the file is binary; save the mesh as text");
  }

  /// Sections end with their name behind "$End"; unknown ones are passed over.
  void skip_to_end(const std::string& section) {
    if (!section.starts_with("$"))
      scanner_.fail("expected the name of a section, found " + in_quotes(section) +
                    "; a count above is wrong or this is no Gmsh file, export it again");
    const std::string end = "$End" + section.substr(1);
    while (!scanner_.is_at_end())
      if (scanner_.rest_of_line().starts_with(end)) return;
    scanner_.fail_at_end(end.c_str());
  }

  /// "2 7 "inlet"": dimension, tag, name.
  void read_names() {
    const std::size_t count = section_count("the number of names", 6);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t dimension = read_dimension();
      const std::int64_t tag = read_tag("a group's tag");
      std::string_view name = scanner_.rest_of_line();
      const auto first = name.find('"'), last = name.rfind('"');
      if (first == std::string_view::npos || last == first)
        scanner_.fail("the name of the group is not in quotes; export the file again");
      group_names_[dimension][tag] = name.substr(first + 1, last - first - 1);
    }
  }

  std::size_t read_dimension() {
    const std::int64_t dimension = scanner_.integer("a dimension");
    if (dimension < 0 || dimension > 3)
      scanner_.fail("the dimension " + std::to_string(dimension) +
                    " is none of 0 to 3; export the file again");
    return static_cast<std::size_t>(dimension);
  }

  /// Of nodes, groups and entities.
  std::int64_t read_tag(const char* what) {
    const std::int64_t tag = scanner_.integer(what);
    constexpr std::int64_t kLargest = std::int64_t{1} << 53;
    if (tag < -kLargest || tag > kLargest)
      scanner_.fail(std::string(what) + " is out of range; the file is damaged, export it again");
    return tag;
  }

  /// No memory is reserved on the word of a count that the rest of the file cannot hold.
  std::size_t section_count(const char* what, std::size_t bytes_each) {
    const std::size_t count = scanner_.count(what);
    if (count > scanner_.bytes_left() / bytes_each + 1 || count > kMaxElements)
      scanner_.fail(std::to_string(count) + " is more than the file holds for " + what +
                    "; it is truncated or damaged, export it again");
    return count;
  }

  /// Points: tag, position, groups; others: tag, box, groups, bounding entities.
  void read_entities() {
    std::array<std::size_t, 4> counts{};
    for (std::size_t& count : counts) count = section_count("the number of entities", 8);
    for (std::size_t dimension = 0; dimension < 4; ++dimension)
      for (std::size_t i = 0; i < counts[dimension]; ++i) {
        const std::int64_t tag = read_tag("an entity's tag");
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) scanner_.real("an entity's box");
        const std::size_t num_groups = section_count("the number of groups", 2);
        for (std::size_t g = 0; g < num_groups; ++g) {
          const std::int64_t group = read_tag("a group's tag");
          if (g == 0) entity_to_group_[dimension][tag] = {group < 0 ? -group : group, true};
        }
        const std::size_t num_bounding =
            dimension == 0 ? 0 : section_count("the number of bounding entities", 2);
        for (std::size_t b = 0; b < num_bounding; ++b) scanner_.integer("a bounding entity");
      }
  }

  void add_node(std::int64_t tag, const Vec3& p) {
    if (!node_to_vert_.try_emplace(tag, VertId(file_.positions.size())).second)
      scanner_.fail("node " + std::to_string(tag) + " comes twice; export the file again");
    file_.positions.push_back(p);
  }

  void read_nodes_2() {
    const std::size_t count = section_count("the number of nodes", 8);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t tag = read_tag("a node's number");
      add_node(tag, scanner_.line_point("a node"));
    }
  }

  /// Blocks: the tags first, then the positions (parameters behind them are passed over).
  void read_nodes_4() {
    const std::size_t num_blocks = section_count("the number of blocks", 8);
    for (int k = 0; k < 3; ++k) scanner_.integer("a count of nodes");
    for (std::size_t b = 0; b < num_blocks; ++b) {
      for (int k = 0; k < 3; ++k) scanner_.integer("the header of a block");
      std::vector<std::int64_t> tags(section_count("the number of nodes", 8));
      for (std::int64_t& tag : tags) tag = read_tag("a node's number");
      for (const std::int64_t tag : tags) {
        scanner_.skip_blank();
        add_node(tag, scanner_.line_point("a node"));
        scanner_.next_line();
      }
    }
  }

  void read_elements_2() {
    const std::size_t count = section_count("the number of elements", 8);
    for (std::size_t i = 0; i < count; ++i) {
      scanner_.integer("an element's number");
      const std::int64_t type = scanner_.integer("an element's type");
      const std::size_t num_tags = section_count("the number of tags", 2);
      GmshGroup group;
      for (std::size_t t = 0; t < num_tags; ++t) {
        const std::int64_t tag = read_tag("a tag");
        if (t == 0 && tag != 0) group = {tag, true};
        if (t == 1 && !group.is_physical) group = {tag, false};
      }
      add_element(type, group);
      scanner_.next_line();
    }
  }

  void read_elements_4() {
    const std::size_t num_blocks = section_count("the number of blocks", 8);
    for (int k = 0; k < 3; ++k) scanner_.integer("a count of elements");
    for (std::size_t b = 0; b < num_blocks; ++b) {
      const std::size_t dimension = read_dimension();
      const std::int64_t entity = read_tag("an entity's tag");
      const std::int64_t type = scanner_.integer("an element's type");
      const std::size_t count = section_count("the number of elements", 4);
      const auto found = entity_to_group_[dimension].find(entity);
      const GmshGroup group =
          found == entity_to_group_[dimension].end() ? GmshGroup{entity, false} : found->second;
      for (std::size_t i = 0; i < count; ++i) {
        scanner_.integer("an element's number");
        add_element(type, group);
        scanner_.next_line();
      }
    }
  }

  template <std::size_t N>
  std::array<VertId, N> read_verts() {
    std::array<VertId, N> verts;
    for (VertId& v : verts) {
      const std::int64_t tag = scanner_.integer("a node of the element");
      const auto found = node_to_vert_.find(tag);
      if (found == node_to_vert_.end())
        scanner_.fail("the element uses node " + std::to_string(tag) +
                      ", which the file does not have; export it again");
      v = found->second;
    }
    return verts;
  }

  void add_hex(const GmshGroup& group) {
    file_.hexes.push_back(read_verts<8>());
    hex_groups_.push_back(group);
  }

  template <std::size_t N>
  void add_quadratic_hex(const GmshGroup& group) {
    const auto in_file = read_verts<N>();
    std::array<VertId, N> nodes;
    for (std::size_t k = 0; k < N; ++k) nodes[kGmshHexOrder[k]] = in_file[k];
    std::array<VertId, 8> corners;
    std::copy(nodes.begin(), nodes.begin() + 8, corners.begin());
    file_.hexes.push_back(corners);
    hex_groups_.push_back(group);
    mid_nodes_.add(file_, nodes);
  }

  /// Of sides and edges of second order the corners count; their mid-nodes are those of the hexes.
  void add_element(std::int64_t type, const GmshGroup& group) {
    switch (type) {
      case Hexahedron:
        return add_hex(group);
      case Hexahedron20:
        return add_quadratic_hex<20>(group);
      case Hexahedron27:
        return add_quadratic_hex<27>(group);
      case Tetra:
        file_.tets.push_back(read_verts<4>());
        return;
      case Quad:
      case Quad8:
      case Quad9:
        file_.labels.quads.push_back({read_verts<4>(), {}});
        quad_groups_.push_back(group);
        return;
      case Line:
      case Line3:
        file_.labels.edges.push_back({read_verts<2>(), {}});
        edge_groups_.push_back(group);
        return;
      case Point:
        file_.labels.corners.push_back(read_verts<1>()[0]);
        return;
      default:
        ++file_.num_others;
    }
  }

  /// Where some elements of a kind are in physical groups, those in none have no label; where none
  /// is, the entities are the groups.
  std::map<std::int64_t, std::int32_t> number(SetKind kind, std::size_t dimension,
                                              std::vector<GmshGroup>& groups) {
    bool has_physical = false;
    for (const GmshGroup& group : groups) has_physical = has_physical || group.is_physical;
    std::map<std::int64_t, std::string> tags;
    for (GmshGroup& group : groups) {
      if (group.is_physical != has_physical) group.tag = 0;
      if (group.tag == 0) continue;
      const auto name = group_names_[dimension].find(group.tag);
      const bool is_named = has_physical && name != group_names_[dimension].end();
      tags[group.tag] = is_named ? name->second : "";
    }
    auto numbers = number_tags(kind, tags, names_);
    numbers.try_emplace(0, -1);
    return numbers;
  }

  void number_groups() {
    const auto patches = number(SetKind::Patch, 2, quad_groups_);
    for (std::size_t q = 0; q < quad_groups_.size(); ++q)
      file_.labels.quads[q].patch = PatchId(patches.at(quad_groups_[q].tag));
    const auto curves = number(SetKind::Curve, 1, edge_groups_);
    for (std::size_t e = 0; e < edge_groups_.size(); ++e)
      file_.labels.edges[e].curve = CurveId(curves.at(edge_groups_[e].tag));
    const auto regions = number(SetKind::Region, 3, hex_groups_);
    for (const GmshGroup& group : hex_groups_) file_.region.push_back(regions.at(group.tag));
  }

  TextScanner scanner_;
  const std::string& name_;
  bool is_version_4_ = true;
  VolumeFile file_;
  MidNodeReader mid_nodes_;
  SetNames names_;
  std::unordered_map<std::int64_t, VertId> node_to_vert_;
  std::array<std::map<std::int64_t, std::string>, 4> group_names_;
  std::array<std::map<std::int64_t, GmshGroup>, 4> entity_to_group_;
  std::vector<GmshGroup> hex_groups_, quad_groups_, edge_groups_;
};

}  // namespace

VolumeFile read_gmsh(const VolumeSource& source) { return GmshReader(source).run(); }

}  // namespace hexwright::io
