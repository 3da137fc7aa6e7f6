// Hex meshes of Gmsh files: hexes, tets, quads, lines and points, with their physical groups (the
// first one of each entity), or their elementary entities where there are no groups.
//
// Differs: elements of other kinds, and tets of second order, are counted and left out.
#include <algorithm>
#include <array>

#include "io/content/foreign_labels.h"
#include "io/content/read_mid_nodes.h"
#include "io/content/set_names.h"
#include "io/mesh/gmsh_order.h"
#include "io/text/gmsh_file.h"

namespace hexwright::io {
namespace {

class GmshReader {
 public:
  explicit GmshReader(const VolumeSource& source)
      : in_(parse_gmsh(source.bytes, source.name)), name_(source.name) {}

  VolumeFile run() {
    file_.positions = std::move(in_.positions);
    file_.num_others = in_.num_others;
    for (const GmshElement& element : in_.elements) add_element(element);
    number_groups();
    mid_nodes_.settle(file_, name_);
    settle_labels(file_);
    names_.apply(file_);
    return std::move(file_);
  }

 private:
  void add_hex(const GmshElement& element) {
    file_.hexes.push_back(in_.verts<8>(element));
    hex_groups_.push_back(element.group);
  }

  template <std::size_t N>
  void add_quadratic_hex(const GmshElement& element) {
    const auto in_file = in_.verts<N>(element);
    std::array<VertId, N> nodes;
    for (std::size_t k = 0; k < N; ++k) nodes[kGmshHexOrder[k]] = in_file[k];
    std::array<VertId, 8> corners;
    std::copy(nodes.begin(), nodes.begin() + 8, corners.begin());
    file_.hexes.push_back(corners);
    hex_groups_.push_back(element.group);
    mid_nodes_.add(file_, nodes);
  }

  /// Of sides and edges of second order the corners count; their mid-nodes are those of the hexes.
  void add_element(const GmshElement& element) {
    switch (element.type) {
      case GmshHexahedron:
        return add_hex(element);
      case GmshHexahedron20:
        return add_quadratic_hex<20>(element);
      case GmshHexahedron27:
        return add_quadratic_hex<27>(element);
      case GmshTetra:
        file_.tets.push_back(in_.verts<4>(element));
        return;
      case GmshQuad:
      case GmshQuad8:
      case GmshQuad9:
        file_.labels.quads.push_back({in_.verts<4>(element), {}});
        quad_groups_.push_back(element.group);
        return;
      case GmshLine:
      case GmshLine3:
        file_.labels.edges.push_back({in_.verts<2>(element), {}});
        edge_groups_.push_back(element.group);
        return;
      case GmshPoint:
        file_.labels.corners.push_back(in_.verts<1>(element)[0]);
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
      const auto name = in_.group_names[dimension].find(group.tag);
      const bool is_named = has_physical && name != in_.group_names[dimension].end();
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

  GmshFile in_;
  const std::string& name_;
  VolumeFile file_;
  MidNodeReader mid_nodes_;
  SetNames names_;
  std::vector<GmshGroup> hex_groups_, quad_groups_, edge_groups_;
};

}  // namespace

VolumeFile read_gmsh(const VolumeSource& source) { return GmshReader(source).run(); }

}  // namespace hexwright::io
