// Parses Gmsh files in text form, section by section.
//
// Based on: Geuzaine, Remacle, "Gmsh reference manual", section "MSH file format".
#include "io/text/gmsh_file.h"

#include <unordered_map>

#include "io/text/text_scanner.h"

namespace hexwright::io {
namespace {

class GmshParser {
 public:
  GmshParser(std::string_view bytes, const std::string& name) : scanner_(bytes, name) {}

  GmshFile run() {
    while (scanner_.skip_blank()) {
      const std::string section(scanner_.line_token());
      scanner_.next_line();
      read_section(section);
    }
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
    const std::size_t count = scanner_.count_of("the number of names", 6);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t dimension = read_dimension();
      const std::int64_t tag = read_tag("a group's tag");
      std::string_view name = scanner_.rest_of_line();
      const auto first = name.find('"'), last = name.rfind('"');
      if (first == std::string_view::npos || last == first)
        scanner_.fail("the name of the group is not in quotes; export the file again");
      file_.group_names[dimension][tag] = name.substr(first + 1, last - first - 1);
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

  /// Points: tag, position, groups; others: tag, box, groups, bounding entities.
  void read_entities() {
    std::array<std::size_t, 4> counts{};
    for (std::size_t& count : counts) count = scanner_.count_of("the number of entities", 8);
    for (std::size_t dimension = 0; dimension < 4; ++dimension)
      for (std::size_t i = 0; i < counts[dimension]; ++i) {
        const std::int64_t tag = read_tag("an entity's tag");
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) scanner_.real("an entity's box");
        const std::size_t num_groups = scanner_.count_of("the number of groups", 2);
        for (std::size_t g = 0; g < num_groups; ++g) {
          const std::int64_t group = read_tag("a group's tag");
          if (g == 0) entity_to_group_[dimension][tag] = {group < 0 ? -group : group, true};
        }
        const std::size_t num_bounding =
            dimension == 0 ? 0 : scanner_.count_of("the number of bounding entities", 2);
        for (std::size_t b = 0; b < num_bounding; ++b) scanner_.integer("a bounding entity");
      }
  }

  void add_node(std::int64_t tag, const Vec3& p) {
    if (!node_to_vert_.try_emplace(tag, VertId(file_.positions.size())).second)
      scanner_.fail("node " + std::to_string(tag) + " comes twice; export the file again");
    file_.positions.push_back(p);
  }

  void read_nodes_2() {
    const std::size_t count = scanner_.count_of("the number of nodes", 8);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t tag = read_tag("a node's number");
      add_node(tag, scanner_.line_point("a node"));
    }
  }

  /// Blocks: the tags first, then the positions (parameters behind them are passed over).
  void read_nodes_4() {
    const std::size_t num_blocks = scanner_.count_of("the number of blocks", 8);
    for (int k = 0; k < 3; ++k) scanner_.integer("a count of nodes");
    for (std::size_t b = 0; b < num_blocks; ++b) {
      for (int k = 0; k < 3; ++k) scanner_.integer("the header of a block");
      std::vector<std::int64_t> tags(scanner_.count_of("the number of nodes", 8));
      for (std::int64_t& tag : tags) tag = read_tag("a node's number");
      for (const std::int64_t tag : tags) {
        scanner_.skip_blank();
        add_node(tag, scanner_.line_point("a node"));
        scanner_.next_line();
      }
    }
  }

  void read_elements_2() {
    const std::size_t count = scanner_.count_of("the number of elements", 8);
    for (std::size_t i = 0; i < count; ++i) {
      scanner_.integer("an element's number");
      const std::int64_t type = scanner_.integer("an element's type");
      const std::size_t num_tags = scanner_.count_of("the number of tags", 2);
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
    const std::size_t num_blocks = scanner_.count_of("the number of blocks", 8);
    for (int k = 0; k < 3; ++k) scanner_.integer("a count of elements");
    for (std::size_t b = 0; b < num_blocks; ++b) {
      const std::size_t dimension = read_dimension();
      const std::int64_t entity = read_tag("an entity's tag");
      const std::int64_t type = scanner_.integer("an element's type");
      const std::size_t count = scanner_.count_of("the number of elements", 4);
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

  static std::size_t num_nodes_of(std::int64_t type) {
    static const std::map<std::int64_t, std::size_t> kNumNodes = {
        {GmshLine, 2},          {GmshTriangle, 3}, {GmshQuad, 4},      {GmshTetra, 4},
        {GmshHexahedron, 8},    {GmshLine3, 3},    {GmshTriangle6, 6}, {GmshQuad9, 9},
        {GmshHexahedron27, 27}, {GmshPoint, 1},    {GmshQuad8, 8},     {GmshHexahedron20, 20}};
    const auto found = kNumNodes.find(type);
    return found == kNumNodes.end() ? 0 : found->second;
  }

  void add_element(std::int64_t type, const GmshGroup& group) {
    const std::size_t num_nodes = num_nodes_of(type);
    if (num_nodes == 0) {
      ++file_.num_others;
      return;
    }
    file_.elements.push_back({type, group, file_.nodes.size()});
    for (std::size_t k = 0; k < num_nodes; ++k) {
      const std::int64_t tag = scanner_.integer("a node of the element");
      const auto found = node_to_vert_.find(tag);
      if (found == node_to_vert_.end())
        scanner_.fail("the element uses node " + std::to_string(tag) +
                      ", which the file does not have; export it again");
      file_.nodes.push_back(found->second);
    }
  }

  TextScanner scanner_;
  bool is_version_4_ = true;
  GmshFile file_;
  std::unordered_map<std::int64_t, VertId> node_to_vert_;
  std::array<std::map<std::int64_t, GmshGroup>, 4> entity_to_group_;
};

}  // namespace

GmshFile parse_gmsh(std::string_view bytes, const std::string& file_name) {
  return GmshParser(bytes, file_name).run();
}

}  // namespace hexwright::io
