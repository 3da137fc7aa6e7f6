// Faces take their numbers in the order in which hexes name them.
#include "io/sets/node_table.h"

#include <algorithm>

#include <fmt/format.h>

#include "hexwright/base/cancel.h"
#include "hexwright/base/error.h"

namespace hexwright::io {

NodeTable::NodeTable(const HexMesh& mesh, int nodes_per_hex)
    : mesh_(mesh), nodes_per_hex_(nodes_per_hex) {
  if (is_linear()) return;
  edges_.emplace(mesh);
  all_ = mesh.positions;
  for (const Vec3& p : mesh.mid_nodes->edges) all_.push_back(p);
  if (nodes_per_hex == 27) number_faces();
}

void NodeTable::number_faces() {
  faces_.emplace(mesh_.hexes);
  face_nodes_.resize(mesh_.num_hexes());
  for (HexId h : mesh_.hexes.ids()) {
    const QuadraticHex nodes = quadratic_hex(mesh_, h);
    for (std::size_t lf = 0; lf < 6; ++lf) {
      const HexFace face = {h, static_cast<int>(lf)};
      const HexFace first = faces_->find(io::face_verts(mesh_.hexes, face))->face;
      face_nodes_[h][lf] = first == face
                               ? all_.push_back(nodes[20 + lf])
                               : face_nodes_[first.hex][static_cast<std::size_t>(first.lf)];
    }
  }
  first_middle_ = all_.size();
  for (HexId h : mesh_.hexes.ids()) all_.push_back(quadratic_hex(mesh_, h)[26]);
}

VertId NodeTable::face(HexFace face) const {
  return face_nodes_[face.hex][static_cast<std::size_t>(face.lf)];
}

NodeList NodeTable::hex(HexId h) const {
  NodeList nodes;
  for (VertId v : mesh_.hexes[h]) nodes.push_back(v);
  if (is_linear()) return nodes;
  for (EdgeId e : mesh_.mid_nodes->hex_to_edge[h]) nodes.push_back(edge_node(e));
  if (nodes_per_hex_ == 20) return nodes;
  for (VertId v : face_nodes_[h]) nodes.push_back(v);
  nodes.push_back(middle(h));
  return nodes;
}

VertId NodeTable::node_between(VertId a, VertId b) const {
  const EdgeId edge = edges_->find(a, b);
  if (edge.is_valid()) return edge_node(edge);
  throw Error(ErrorCode::BadArgument,
              fmt::format("the labelled edge from vertex {} to {} is no edge of any hex; remove it "
                          "from the labels",
                          a.value(), b.value()));
}

HexFace NodeTable::find_face(const std::array<VertId, 4>& verts) const {
  if (const auto found = faces_->find(verts)) return found->face;
  throw Error(ErrorCode::BadArgument,
              fmt::format("the labelled quad of vertices {}, {}, {} and {} is no face of any hex; "
                          "remove it from the labels",
                          verts[0].value(), verts[1].value(), verts[2].value(), verts[3].value()));
}

NodeList NodeTable::quad(const std::array<VertId, 4>& verts) const {
  NodeList nodes;
  for (VertId v : verts) nodes.push_back(v);
  if (is_linear()) return nodes;
  for (std::size_t k = 0; k < 4; ++k) nodes.push_back(node_between(verts[k], verts[(k + 1) % 4]));
  if (nodes_per_hex_ == 27) nodes.push_back(face(find_face(verts)));
  return nodes;
}

NodeList NodeTable::edge(const std::array<VertId, 2>& verts) const {
  NodeList nodes;
  for (VertId v : verts) nodes.push_back(v);
  if (!is_linear()) nodes.push_back(node_between(verts[0], verts[1]));
  return nodes;
}

NodeList NodeTable::element(SetKind kind, std::size_t member) const {
  switch (kind) {
    case SetKind::Region:
      return hex(HexId(member));
    case SetKind::Curve:
      return edge(mesh_.labels.edges[member].verts);
    case SetKind::Corners: {
      NodeList node;
      node.push_back(mesh_.labels.corners[member]);
      return node;
    }
    default:
      return quad(mesh_.labels.quads[member].verts);
  }
}

/// By marks: a region's nodes are most of the mesh, each of several hexes.
std::vector<VertId> NodeTable::region_nodes(const NamedSet& set) const {
  IdVector<VertId, char> is_used(size(), 0);
  CancelCheck check_cancelled;
  for (std::size_t h : set.members) {
    check_cancelled();
    for (VertId v : hex(HexId(h))) is_used[v] = 1;
  }
  std::vector<VertId> nodes;
  for (VertId v : is_used.ids())
    if (is_used[v]) nodes.push_back(v);
  return nodes;
}

std::vector<VertId> NodeTable::set_nodes(const NamedSet& set) const {
  if (set.kind == SetKind::Region) return region_nodes(set);
  std::vector<VertId> nodes;
  CancelCheck check_cancelled;
  for (std::size_t i : set.members) {
    check_cancelled();
    const NodeList list = element(set.kind, i);
    nodes.insert(nodes.end(), list.begin(), list.end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace hexwright::io
