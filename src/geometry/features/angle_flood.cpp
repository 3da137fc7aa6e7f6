// A walk over triangles that share an edge by its places.
#include "geometry/features/angle_flood.h"

#include <algorithm>
#include <array>
#include <utility>

#include "hexwright/geometry/surface_tree.h"

#include "geometry/topology/surface_edges.h"
#include "geometry/tree/triangle_math.h"

namespace hexwright {
namespace {

/// Vertices in one place are the lowest of them.
TriMesh weld(TriMesh mesh) {
  std::vector<VertId> order;
  for (VertId v : mesh.positions.ids()) order.push_back(v);
  const auto key = [&](VertId v) {
    const Vec3& p = mesh.positions[v];
    return std::array{p.x + 0.0, p.y + 0.0, p.z + 0.0};  // minus zero is zero
  };
  std::sort(order.begin(), order.end(),
            [&](VertId a, VertId b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  IdVector<VertId, VertId> place(mesh.num_verts());
  for (std::size_t i = 0; i < order.size(); ++i)
    place[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? place[order[i - 1]] : order[i];
  for (auto& tri : mesh.tris)
    for (VertId& v : tri) v = place[v];
  return mesh;
}

/// A triangle across an edge, and whether it goes round the other way.
struct Neighbor {
  TriId tri;
  bool is_turned;
};

IdVector<TriId, std::vector<Neighbor>> find_neighbors(const TriMesh& mesh) {
  IdVector<TriId, std::vector<Neighbor>> neighbors(mesh.num_tris());
  const SurfaceEdges edges = compute_surface_edges(mesh);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges.sides_of(e);
    if (sides.size() != 2) continue;
    const bool is_turned = sides[0].is_forward == sides[1].is_forward;
    neighbors[sides[0].tri].push_back({sides[1].tri, is_turned});
    neighbors[sides[1].tri].push_back({sides[0].tri, is_turned});
  }
  return neighbors;
}

}  // namespace

std::vector<char> flood_by_angle(const TriMesh& surface, const Vec3& seed, double least_cosine) {
  constexpr double kRounding = 1e-12;
  std::vector<char> is_reached(surface.num_tris(), 0);
  const auto nearest = SurfaceTree(surface).closest(seed);
  if (!nearest) return is_reached;
  const TriMesh mesh = weld(surface);
  const auto neighbors = find_neighbors(mesh);
  // With the normal of the last triangle that had one: those without area hide no bend.
  std::vector<std::pair<TriId, Vec3>> front = {
      {nearest->tri, unit_normal(mesh.corners(nearest->tri))}};
  is_reached[nearest->tri.index()] = 1;
  while (!front.empty()) {
    const auto [tri, normal] = front.back();
    front.pop_back();
    for (const Neighbor& other : neighbors[tri]) {
      if (is_reached[other.tri.index()]) continue;
      const Vec3 before = other.is_turned ? -normal : normal,
                 own = unit_normal(mesh.corners(other.tri));
      const bool has_both = before != Vec3{} && own != Vec3{};
      if (has_both && dot(before, own) < least_cosine - kRounding) continue;
      is_reached[other.tri.index()] = 1;
      front.emplace_back(other.tri, own == Vec3{} ? before : own);
    }
  }
  return is_reached;
}

}  // namespace hexwright
