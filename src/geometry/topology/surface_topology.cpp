// Components, Euler characteristic and defects of any triangle soup, by union-find.
//
// Euler: V - E + F = 2 (components - genus) on closed manifolds. Vertices that no triangle uses do
// not count.
#include "hexwright/geometry/surface_topology.h"

#include <algorithm>
#include <vector>

#include "hexwright/base/parallel.h"

#include "geometry/topology/surface_edges.h"

namespace hexwright {
namespace {

/// Number (3 * triangle + k) of the corner that a side's triangle has at one of the side's ends.
int corner_at(const TriMesh& surface, const SurfaceEdges::Side& side, VertId v) {
  const auto& verts = surface.tris[side.tri];
  const int k = verts[static_cast<std::size_t>(side.k)] == v ? side.k : (side.k + 1) % 3;
  return 3 * side.tri.value() + k;
}

/// Corners of triangles at one vertex belong together when their triangles share an edge there;
/// every further set at a vertex is another fan.
std::size_t count_nonmanifold_verts(const TriMesh& surface, const SurfaceEdges& edges) {
  const std::size_t num_corners = 3 * surface.num_tris();
  UnionFind fans(num_corners);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges.sides_of(e);
    for (std::size_t i = 1; i < sides.size(); ++i)
      for (VertId v : {edges.lo(e), edges.hi(e)})
        fans.unite(corner_at(surface, sides[i - 1], v), corner_at(surface, sides[i], v));
  }
  IdVector<VertId, int> num_fans(surface.num_verts(), 0);
  for (std::size_t c = 0; c < num_corners; ++c)
    if (fans.find(static_cast<int>(c)) == static_cast<int>(c))
      ++num_fans[surface.tris[TriId(c / 3)][c % 3]];
  std::size_t count = 0;
  for (int n : num_fans) count += n > 1;
  return count;
}

UnionFind unite_across_edges(const TriMesh& surface, const SurfaceEdges& edges) {
  UnionFind sets(surface.num_tris());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges.sides_of(e);
    for (std::size_t i = 1; i < sides.size(); ++i)
      sets.unite(sides[0].tri.value(), sides[i].tri.value());
  }
  return sets;
}

std::size_t count_used_verts(const TriMesh& surface) {
  IdVector<VertId, char> is_used(surface.num_verts(), 0);
  for (const auto& tri : surface.tris)
    for (VertId v : tri) is_used[v] = 1;
  std::size_t count = 0;
  for (char used : is_used) count += used != 0;
  return count;
}

}  // namespace

IdVector<TriId, int> compute_components(const TriMesh& surface) {
  UnionFind sets = unite_across_edges(surface, compute_surface_edges(surface));
  return IdVector<TriId, int>(number_sets(sets, surface.num_tris()));
}

SurfaceTopology compute_topology(const TriMesh& surface) {
  const SurfaceEdges edges = compute_surface_edges(surface);
  SurfaceTopology result;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    result.num_boundary_edges += edges.sides_of(e).size() == 1;
    result.num_nonmanifold_edges += edges.sides_of(e).size() > 2;
  }
  result.num_nonmanifold_verts = count_nonmanifold_verts(surface, edges);
  UnionFind sets = unite_across_edges(surface, edges);
  for (TriId t : surface.tris.ids()) result.num_components += sets.find(t.value()) == t.value();
  result.euler_characteristic = static_cast<long>(count_used_verts(surface)) -
                                static_cast<long>(edges.size()) +
                                static_cast<long>(surface.num_tris());
  return result;
}

/// The boundary operator of the triangles as a chain of integers vanishes: each edge is run through
/// as often one way as the other, whatever the number of triangles around it.
bool is_oriented_cycle(const TriMesh& surface) {
  struct Edge {
    VertId lo, hi;
    int sign;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * surface.num_tris());
  for (const auto& tri : surface.tris)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertId a = tri[k], b = tri[(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  parallel_stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.lo != b.lo ? a.lo < b.lo : a.hi < b.hi;
  });
  int balance = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    balance += edges[i].sign;
    const bool is_last =
        i + 1 == edges.size() || edges[i + 1].lo != edges[i].lo || edges[i + 1].hi != edges[i].hi;
    if (is_last && balance != 0) return false;
  }
  return true;
}

}  // namespace hexwright
