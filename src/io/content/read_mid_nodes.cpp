// Edges are shared: whichever hex names the node of an edge first settles it.
#include "io/content/read_mid_nodes.h"

#include <algorithm>

#include "io/text/file_bytes.h"

namespace hexwright::io {
namespace {

/// Two nodes of one edge that are nearer to each other than this share of its length are one.
constexpr double kSameNode = 1e-6;

using HexToNodes = IdVector<HexId, std::array<VertId, 19>>;

class Settler {
 public:
  Settler(VolumeFile& file, const HexToNodes& hex_to_nodes, const std::string& name)
      : file_(file), hex_to_nodes_(hex_to_nodes), name_(name) {
    mesh_.hexes = file.hexes;
    mesh_.positions = file.positions;
    nodes_ = make_straight_mid_nodes(mesh_);
  }

  MidNodes run() {
    settle_edges();
    const auto has_inner = [](const auto& nodes) { return nodes[18].is_valid(); };
    if (std::any_of(hex_to_nodes_.begin(), hex_to_nodes_.end(), has_inner)) settle_inner();
    return std::move(nodes_);
  }

 private:
  void settle_edges() {
    IdVector<EdgeId, HexId> owner(nodes_.edges.size());
    for (HexId h : hex_to_nodes_.ids())
      for (std::size_t le = 0; le < 12; ++le) {
        const VertId v = hex_to_nodes_[h][le];
        if (!v.is_valid()) continue;
        const EdgeId e = nodes_.hex_to_edge[h][le];
        if (!owner[e].is_valid()) {
          owner[e] = h;
          nodes_.edges[e] = file_.positions[v];
        } else if (distance(nodes_.edges[e], file_.positions[v]) > kSameNode * length_of(h, le)) {
          throw bad_element(name_, "hex " + std::to_string(h.value()),
                            "it shares an edge with hex " + std::to_string(owner[e].value()) +
                                ", but not the node in its middle; export the file again");
        }
      }
  }

  double length_of(HexId h, std::size_t le) const {
    const auto corners = mesh_.corners(h);
    return distance(corners[static_cast<std::size_t>(kHexEdges[le][0])],
                    corners[static_cast<std::size_t>(kHexEdges[le][1])]);
  }

  void settle_inner() {
    mesh_.mid_nodes = nodes_;
    nodes_.inner.resize(mesh_.num_hexes());
    for (HexId h : mesh_.hexes.ids()) {
      const QuadraticHex filled = quadratic_hex(mesh_, h);
      for (std::size_t k = 0; k < 7; ++k) {
        const VertId v = hex_to_nodes_[h][12 + k];
        nodes_.inner[h][k] = v.is_valid() ? file_.positions[v] : filled[20 + k];
      }
    }
  }

  VolumeFile& file_;
  const HexToNodes& hex_to_nodes_;
  const std::string& name_;
  HexMesh mesh_;
  MidNodes nodes_;
};

/// Calls `visit` for every vertex of an element or label.
template <class Visit>
void visit_verts(VolumeFile& file, Visit&& visit) {
  for (auto& hex : file.hexes)
    for (VertId& v : hex) visit(v);
  for (auto& tet : file.tets)
    for (VertId& v : tet) visit(v);
  for (LabeledQuad& quad : file.labels.quads)
    for (VertId& v : quad.verts) visit(v);
  for (LabeledEdge& edge : file.labels.edges)
    for (VertId& v : edge.verts) visit(v);
  for (VertId& v : file.labels.corners) visit(v);
}

void drop_mid_nodes(const HexToNodes& hex_to_nodes, VolumeFile& file) {
  IdVector<VertId, char> is_dropped(file.positions.size(), 0);
  for (const auto& nodes : hex_to_nodes)
    for (VertId v : nodes)
      if (v.is_valid()) is_dropped[v] = 1;
  visit_verts(file, [&](VertId v) { is_dropped[v] = 0; });
  IdVector<VertId, VertId> old_to_new(file.positions.size());
  IdVector<VertId, Vec3> positions;
  for (VertId v : file.positions.ids())
    if (!is_dropped[v]) old_to_new[v] = positions.push_back(file.positions[v]);
  file.positions = std::move(positions);
  visit_verts(file, [&](VertId& v) { v = old_to_new[v]; });
}

}  // namespace

void MidNodeReader::add(const VolumeFile& file, std::span<const VertId> nodes) {
  hex_to_nodes_.resize(file.hexes.size());
  auto& own = hex_to_nodes_[HexId(file.hexes.size() - 1)];
  std::copy(nodes.begin() + 8, nodes.end(), own.begin());
}

void MidNodeReader::settle(VolumeFile& file, const std::string& name) {
  if (hex_to_nodes_.empty()) return;
  hex_to_nodes_.resize(file.hexes.size());
  file.mid_nodes = Settler(file, hex_to_nodes_, name).run();
  drop_mid_nodes(hex_to_nodes_, file);
}

}  // namespace hexwright::io
