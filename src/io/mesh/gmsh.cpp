// Writes Gmsh files as text, versions 4.1 and 2.2.
//
// Physical groups carry the sets: volumes for regions, surfaces for patches, curves and points.
// Every set is one elementary entity of the same dimension; in version 4.1 all nodes belong to the
// first volume, and a patch "wall.2" is in the physical group "wall" too (an element of version 2.2
// has one group only).
//
// Based on: Geuzaine, Remacle, "Gmsh reference manual", section "MSH file format", versions 4.1 and
// 2. Corners of its hexahedron and quadrilateral have our local order.
#include <algorithm>

#include "io/content/volume_file.h"
#include "io/mesh/gmsh_order.h"
#include "io/text/text_writer.h"

namespace hexwright::io {
namespace {

constexpr int kGmshPoint = 15;

/// Gmsh's element types for each number of nodes per hex.
struct GmshTypes {
  int line, quad, hex;
};
GmshTypes gmsh_types(int nodes_per_hex) {
  if (nodes_per_hex == 27) return {8, 10, 12};
  if (nodes_per_hex == 20) return {8, 16, 17};
  return {1, 3, 5};
}

/// Our number of each of its nodes.
NodeList to_gmsh_order(const NodeList& hex) {
  NodeList nodes;
  for (std::size_t k = 0; k < hex.size(); ++k) nodes.push_back(hex[kGmshHexOrder[k]]);
  return nodes;
}

/// Entity and physical tags must be positive: number + 1, moved up when numbers are negative (-1 is
/// "none").
class TagMap {
 public:
  explicit TagMap(const std::vector<NamedSet>& sets)
      : lowest_(sets.empty() ? 0 : std::min(0, sets.front().number)),
        highest_(sets.empty() ? 0 : (*this)(sets.back().number)) {}
  std::int64_t operator()(std::int32_t number) const { return std::int64_t{number} - lowest_ + 1; }
  std::int64_t highest() const { return highest_; }

 private:
  std::int32_t lowest_;
  std::int64_t highest_;
};

class GmshWriter {
 public:
  GmshWriter(const NodeTable& nodes, const SetTable& table)
      : nodes_(nodes),
        mesh_(nodes.mesh()),
        types_(gmsh_types(nodes.nodes_per_hex())),
        table_(table),
        regions_(table.regions),
        patches_(table.patches),
        curves_(table.curves) {}

  std::string run_4() {
    out_.text("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    write_names(true);
    write_entities();
    write_nodes_4();
    write_elements_4();
    return out_.take();
  }

  std::string run_2() {
    out_.text("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
    write_names(false);
    out_.text("$Nodes\n").integer(nodes_.size()).text("\n");
    for (VertId v : nodes_.positions().ids())
      out_.integer(v.value() + 1).text(" ").point(nodes_.positions()[v]).text("\n");
    out_.text("$EndNodes\n");
    write_elements_2();
    return out_.take();
  }

 private:
  void name(int dimension, std::int64_t tag, const std::string& text) {
    out_.integer(dimension).text(" ").integer(tag).text(" \"").text(text).text("\"\n");
  }

  /// Groups of patches have the tags behind those of the patches.
  void write_names(bool with_groups) {
    const std::size_t num_groups = with_groups ? table_.patch_groups.size() : 0;
    out_.text("$PhysicalNames\n")
        .integer(table_.regions.size() + table_.patches.size() + num_groups + table_.curves.size() +
                 table_.corners.size())
        .text("\n");
    for (const NamedSet& set : table_.corners) name(0, 1, set.name);
    for (const NamedSet& set : table_.curves) name(1, curves_(set.number), set.name);
    for (const NamedSet& set : table_.patches) name(2, patches_(set.number), set.name);
    for (std::size_t g = 0; g < num_groups; ++g) name(2, group_tag(g), table_.patch_groups[g].name);
    for (const NamedSet& set : table_.regions) name(3, regions_(set.number), set.name);
    out_.text("$EndPhysicalNames\n");
  }

  std::int64_t group_tag(std::size_t g) const {
    return patches_.highest() + static_cast<std::int64_t>(g) + 1;
  }

  /// One entity: tag, box, its physical groups, no bounding entities.
  void entity(std::int64_t tag, const NamedSet& set) {
    Box3 box;
    for (VertId v : nodes_.set_nodes(set)) box.extend(nodes_.positions()[v]);
    std::vector<std::int64_t> groups = {tag};
    if (set.kind == SetKind::Patch)
      for (std::size_t g = 0; g < table_.patch_groups.size(); ++g)
        if (is_in_group(set, table_.patch_groups[g])) groups.push_back(group_tag(g));
    out_.integer(tag).text(" ").point(box.lo).text(" ").point(box.hi).text(" ");
    out_.integer(groups.size());
    for (std::int64_t group : groups) out_.text(" ").integer(group);
    out_.text(" 0\n");
  }

  void write_entities() {
    out_.text("$Entities\n").integer(mesh_.labels.corners.size()).text(" ");
    out_.integer(table_.curves.size()).text(" ").integer(table_.patches.size());
    out_.text(" ").integer(table_.regions.size()).text("\n");
    for (std::size_t c = 0; c < mesh_.labels.corners.size(); ++c)
      out_.integer(c + 1).text(" ").point(mesh_.positions[mesh_.labels.corners[c]]).text(" 1 1\n");
    for (const NamedSet& set : table_.curves) entity(curves_(set.number), set);
    for (const NamedSet& set : table_.patches) entity(patches_(set.number), set);
    for (const NamedSet& set : table_.regions) entity(regions_(set.number), set);
    out_.text("$EndEntities\n");
  }

  void write_nodes_4() {
    const std::size_t count = nodes_.size();
    const std::int64_t volume = table_.regions.empty() ? 1 : regions_(table_.regions[0].number);
    out_.text("$Nodes\n1 ").integer(count).text(" 1 ").integer(count).text("\n3 ");
    out_.integer(volume).text(" 0 ").integer(count).text("\n");
    for (std::size_t v = 1; v <= count; ++v) out_.integer(v).text("\n");
    for (const Vec3& p : nodes_.positions()) out_.point(p).text("\n");
    out_.text("$EndNodes\n");
  }

  void block(int dimension, std::int64_t entity_tag, int type, std::size_t count) {
    out_.integer(dimension).text(" ").integer(entity_tag).text(" ").integer(type).text(" ");
    out_.integer(count).text("\n");
  }
  template <class Verts>
  void element(const Verts& verts) {
    out_.integer(++last_element_).text(" ").indices(verts, 1).text("\n");
  }

  std::size_t num_elements() const {
    const BoundaryLabels& labels = mesh_.labels;
    return labels.corners.size() + labels.edges.size() + labels.quads.size() + mesh_.num_hexes();
  }

  void write_elements_4() {
    const BoundaryLabels& labels = mesh_.labels;
    const std::size_t count = num_elements();
    out_.text("$Elements\n")
        .integer(labels.corners.size() + table_.curves.size() + table_.patches.size() +
                 table_.regions.size())
        .text(" ");
    out_.integer(count).text(" 1 ").integer(count).text("\n");
    for (std::size_t c = 0; c < labels.corners.size(); ++c) {
      block(0, static_cast<std::int64_t>(c) + 1, kGmshPoint, 1);
      element(std::array{labels.corners[c]});
    }
    for (const NamedSet& set : table_.curves) {
      block(1, curves_(set.number), types_.line, set.members.size());
      for (std::size_t e : set.members) element(nodes_.edge(labels.edges[e].verts));
    }
    for (const NamedSet& set : table_.patches) {
      block(2, patches_(set.number), types_.quad, set.members.size());
      for (std::size_t q : set.members) element(nodes_.quad(labels.quads[q].verts));
    }
    for (const NamedSet& set : table_.regions) {
      block(3, regions_(set.number), types_.hex, set.members.size());
      for (std::size_t h : set.members) element(to_gmsh_order(nodes_.hex(HexId(h))));
    }
    out_.text("$EndElements\n");
  }

  /// Number, type, two tags (physical and elementary), nodes.
  template <class Verts>
  void element_2(int type, std::int64_t physical, std::int64_t elementary, const Verts& verts) {
    out_.integer(++last_element_).text(" ").integer(type).text(" 2 ").integer(physical);
    out_.text(" ").integer(elementary).text(" ").indices(verts, 1).text("\n");
  }

  void write_elements_2() {
    const BoundaryLabels& labels = mesh_.labels;
    out_.text("$Elements\n").integer(num_elements()).text("\n");
    for (std::size_t c = 0; c < labels.corners.size(); ++c)
      element_2(kGmshPoint, 1, static_cast<std::int64_t>(c) + 1, std::array{labels.corners[c]});
    for (const NamedSet& set : table_.curves)
      for (std::size_t e : set.members)
        element_2(types_.line, curves_(set.number), curves_(set.number),
                  nodes_.edge(labels.edges[e].verts));
    for (const NamedSet& set : table_.patches)
      for (std::size_t q : set.members)
        element_2(types_.quad, patches_(set.number), patches_(set.number),
                  nodes_.quad(labels.quads[q].verts));
    for (const NamedSet& set : table_.regions)
      for (std::size_t h : set.members)
        element_2(types_.hex, regions_(set.number), regions_(set.number),
                  to_gmsh_order(nodes_.hex(HexId(h))));
    out_.text("$EndElements\n");
  }

  const NodeTable& nodes_;
  const HexMesh& mesh_;
  GmshTypes types_;
  const SetTable& table_;
  TagMap regions_, patches_, curves_;
  TextWriter out_;
  std::size_t last_element_ = 0;
};

}  // namespace

NameRules gmsh_names() {
  NameRules rules;
  rules.max_length = 127;
  rules.is_allowed = [](char c) { return c != '"'; };
  rules.is_unique_per_kind = true;
  return rules;
}

std::string gmsh_text(const NodeTable& nodes, const SetTable& table) {
  return GmshWriter(nodes, table).run_4();
}

std::string gmsh2_text(const NodeTable& nodes, const SetTable& table) {
  return GmshWriter(nodes, table).run_2();
}

}  // namespace hexwright::io
