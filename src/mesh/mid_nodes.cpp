// Numbering of edges, and nodes that follow from others.
#include "hexwright/mesh/mid_nodes.h"

#include <algorithm>

#include "hexwright/base/parallel.h"
#include "hexwright/mesh/hex_mesh.h"

namespace hexwright {
namespace {

constexpr std::size_t kNumEdges = 12;

/// An edge of a hex: slot 12 * hex + local edge.
struct EdgeSlot {
  std::array<VertId, 2> verts;  // increasing
  std::size_t slot = 0;
};

std::array<VertId, 2> verts_of(const HexMesh& mesh, HexId h, std::size_t le) {
  const auto& hex = mesh.hexes[h];
  const auto [a, b] = std::minmax(hex[static_cast<std::size_t>(kHexEdges[le][0])],
                                  hex[static_cast<std::size_t>(kHexEdges[le][1])]);
  return {a, b};
}

std::vector<EdgeSlot> sorted_slots(const HexMesh& mesh) {
  std::vector<EdgeSlot> slots(kNumEdges * mesh.num_hexes());
  parallel_for(slots.size(), [&](std::size_t i) {
    slots[i] = {verts_of(mesh, HexId(i / kNumEdges), i % kNumEdges), i};
  });
  parallel_stable_sort(slots.begin(), slots.end(),
                       [](const EdgeSlot& a, const EdgeSlot& b) { return a.verts < b.verts; });
  return slots;
}

constexpr int edge_between(int a, int b) {
  for (int e = 0; e < 12; ++e) {
    const auto& edge = kHexEdges[static_cast<std::size_t>(e)];
    if ((edge[0] == a && edge[1] == b) || (edge[0] == b && edge[1] == a)) return e;
  }
  return -1;
}

/// Local edges of each face: side k runs from the face's vertex k to k + 1.
constexpr std::array<std::array<std::size_t, 4>, 6> make_face_edges() {
  std::array<std::array<std::size_t, 4>, 6> table{};
  for (std::size_t lf = 0; lf < 6; ++lf)
    for (std::size_t k = 0; k < 4; ++k)
      table[lf][k] =
          static_cast<std::size_t>(edge_between(kHexFaces[lf][k], kHexFaces[lf][(k + 1) % 4]));
  return table;
}
constexpr auto kFaceEdges = make_face_edges();

/// Values at t of the three functions that are 1 at 0, 1/2 and 1.
std::array<double, 3> quadratic_weights(double t) {
  return {(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)};
}

}  // namespace

std::optional<Issue> MidNodes::find_problem(std::size_t num_hexes) const {
  if (hex_to_edge.size() != num_hexes || (!inner.empty() && inner.size() != num_hexes))
    return Issue{"mid-nodes do not match the number of hexes"};
  for (HexId h : hex_to_edge.ids())
    for (EdgeId e : hex_to_edge[h])
      if (!e.is_valid() || e.index() >= edges.size())
        return Issue{"hex " + std::to_string(h.value()) + " uses edge " +
                     std::to_string(e.value()) + " of " + std::to_string(edges.size())};
  for (EdgeId e : edges.ids())
    if (!is_finite(edges[e]))
      return Issue{"the mid-node of edge " + std::to_string(e.value()) +
                   " has a coordinate that is not finite"};
  for (HexId h : inner.ids())
    for (const Vec3& p : inner[h])
      if (!is_finite(p))
        return Issue{"a mid-node of hex " + std::to_string(h.value()) +
                     " has a coordinate that is not finite"};
  return std::nullopt;
}

MidNodes make_straight_mid_nodes(const HexMesh& mesh) {
  const std::vector<EdgeSlot> slots = sorted_slots(mesh);
  std::vector<std::size_t> slot_to_first(slots.size());  // of the same edge, the lowest slot
  for (std::size_t i = 0, first = 0; i < slots.size(); ++i) {
    if (slots[i].verts != slots[first].verts) first = i;
    slot_to_first[slots[i].slot] = slots[first].slot;
  }
  MidNodes nodes;
  nodes.hex_to_edge.resize(mesh.num_hexes());
  const auto at = [&](std::size_t slot) -> EdgeId& {
    return nodes.hex_to_edge[HexId(slot / kNumEdges)][slot % kNumEdges];
  };
  for (std::size_t slot = 0; slot < slot_to_first.size(); ++slot) {
    if (slot_to_first[slot] != slot) {
      at(slot) = at(slot_to_first[slot]);
      continue;
    }
    const auto verts = verts_of(mesh, HexId(slot / kNumEdges), slot % kNumEdges);
    at(slot) =
        nodes.edges.push_back(0.5 * mesh.positions[verts[0]] + 0.5 * mesh.positions[verts[1]]);
  }
  return nodes;
}

IdVector<EdgeId, std::array<VertId, 2>> edge_verts(const HexMesh& mesh) {
  IdVector<EdgeId, std::array<VertId, 2>> verts(mesh.mid_nodes->edges.size());
  for (HexId h : mesh.hexes.ids())
    for (std::size_t le = 0; le < kNumEdges; ++le)
      verts[mesh.mid_nodes->hex_to_edge[h][le]] = verts_of(mesh, h, le);
  return verts;
}

void fill_inner_nodes(QuadraticHex& nodes) {
  for (std::size_t lf = 0; lf < 6; ++lf) {
    Vec3 corners, edges;
    for (std::size_t k = 0; k < 4; ++k) {
      corners += nodes[static_cast<std::size_t>(kHexFaces[lf][k])];
      edges += nodes[8 + kFaceEdges[lf][k]];
    }
    nodes[20 + lf] = 0.5 * edges - 0.25 * corners;
  }
  Vec3 corners, edges;
  for (std::size_t k = 0; k < 8; ++k) corners += nodes[k];
  for (std::size_t k = 8; k < 20; ++k) edges += nodes[k];
  nodes[26] = 0.25 * edges - 0.25 * corners;
}

QuadraticHex quadratic_hex(const HexMesh& mesh, HexId h) {
  QuadraticHex nodes;
  const auto corners = mesh.corners(h);
  std::copy(corners.begin(), corners.end(), nodes.begin());
  for (std::size_t le = 0; le < kNumEdges; ++le)
    nodes[8 + le] = mesh.mid_nodes ? mesh.mid_nodes->edges[mesh.mid_nodes->hex_to_edge[h][le]]
                                   : 0.5 * corners[static_cast<std::size_t>(kHexEdges[le][0])] +
                                         0.5 * corners[static_cast<std::size_t>(kHexEdges[le][1])];
  if (mesh.mid_nodes && !mesh.mid_nodes->inner.empty())
    std::copy(mesh.mid_nodes->inner[h].begin(), mesh.mid_nodes->inner[h].end(), nodes.begin() + 20);
  else
    fill_inner_nodes(nodes);
  return nodes;
}

QuadraticQuad quadratic_face(const QuadraticHex& nodes, int lf) {
  const auto f = static_cast<std::size_t>(lf);
  QuadraticQuad quad;
  for (std::size_t k = 0; k < 4; ++k) {
    quad[k] = nodes[static_cast<std::size_t>(kHexFaces[f][k])];
    quad[4 + k] = nodes[8 + kFaceEdges[f][k]];
  }
  quad[8] = nodes[20 + f];
  return quad;
}

Vec3 point_on(const QuadraticQuad& quad, double u, double v) {
  constexpr std::size_t kRows[3][3] = {{0, 4, 1}, {7, 8, 5}, {3, 6, 2}};
  const auto in_u = quadratic_weights(u), in_v = quadratic_weights(v);
  Vec3 p;
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < 3; ++i) p += in_v[j] * in_u[i] * quad[kRows[j][i]];
  return p;
}

EdgeTable::EdgeTable(const HexMesh& mesh) {
  const auto verts = edge_verts(mesh);
  entries_.reserve(verts.size());
  for (EdgeId e : verts.ids()) entries_.push_back({verts[e], e});
  parallel_stable_sort(entries_.begin(), entries_.end(),
                       [](const Entry& a, const Entry& b) { return a.verts < b.verts; });
}

EdgeId EdgeTable::find(VertId a, VertId b) const {
  const std::array<VertId, 2> key = {std::min(a, b), std::max(a, b)};
  const auto found =
      std::lower_bound(entries_.begin(), entries_.end(), key,
                       [](const Entry& entry, const auto& wanted) { return entry.verts < wanted; });
  return found == entries_.end() || found->verts != key ? EdgeId() : found->edge;
}

QuadraticQuad quadratic_quad(const HexMesh& mesh, const EdgeTable& edges,
                             const std::array<VertId, 4>& verts) {
  QuadraticQuad quad;
  Vec3 corners, sides;
  for (std::size_t k = 0; k < 4; ++k) {
    const VertId a = verts[k], b = verts[(k + 1) % 4];
    const EdgeId edge = edges.find(a, b);
    quad[k] = mesh.positions[a];
    quad[4 + k] = edge.is_valid() ? mesh.mid_nodes->edges[edge]
                                  : 0.5 * mesh.positions[a] + 0.5 * mesh.positions[b];
    corners += quad[k];
    sides += quad[4 + k];
  }
  quad[8] = 0.5 * sides - 0.25 * corners;
  return quad;
}

}  // namespace hexwright
