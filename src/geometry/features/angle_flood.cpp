// A breadth-first walk over triangles that share an edge by its places.
#include "geometry/features/angle_flood.h"

#include <algorithm>
#include <array>

#include "hexwright/geometry/surface_tree.h"

namespace hexwright {
namespace {

/// An edge as one triangle has it; `runs_up` from the lower to the higher end.
struct Side {
  std::array<std::size_t, 2> ends;
  TriId tri;
  bool runs_up;
  bool operator<(const Side& other) const {
    return std::pair(ends, tri) < std::pair(other.ends, other.tri);
  }
};

/// The lowest vertex in the place of each.
IdVector<VertId, std::size_t> weld(const TriMesh& mesh) {
  std::vector<VertId> order;
  for (VertId v : mesh.positions.ids()) order.push_back(v);
  const auto key = [&](VertId v) {
    const Vec3& p = mesh.positions[v];
    return std::array{p.x + 0.0, p.y + 0.0, p.z + 0.0};  // minus zero is zero
  };
  std::sort(order.begin(), order.end(),
            [&](VertId a, VertId b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  IdVector<VertId, std::size_t> place(mesh.num_verts());
  for (std::size_t i = 0; i < order.size(); ++i)
    place[order[i]] =
        i > 0 && key(order[i]) == key(order[i - 1]) ? place[order[i - 1]] : order[i].index();
  return place;
}

std::vector<Side> sorted_sides(const TriMesh& mesh) {
  const auto place = weld(mesh);
  std::vector<Side> sides;
  for (TriId t : mesh.tris.ids())
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = place[mesh.tris[t][k]], b = place[mesh.tris[t][(k + 1) % 3]];
      if (a != b) sides.push_back({{std::min(a, b), std::max(a, b)}, t, a < b});
    }
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// Of triangles that share an edge; one without area hides no bend.
bool is_smooth(const TriMesh& mesh, const Side& a, const Side& b, double least_cosine) {
  const auto normal = [&](TriId t) {
    const auto p = mesh.corners(t);
    return normalized(cross(p[1] - p[0], p[2] - p[0]));
  };
  const Vec3 na = normal(a.tri), nb = normal(b.tri);
  if (na == Vec3{} || nb == Vec3{}) return true;
  const double sign = a.runs_up == b.runs_up ? -1 : 1;
  constexpr double kRounding = 1e-12;
  return sign * dot(na, nb) >= least_cosine - kRounding;
}

}  // namespace

std::vector<char> flood_by_angle(const TriMesh& mesh, const Vec3& seed, double least_cosine) {
  std::vector<char> is_reached(mesh.num_tris(), 0);
  const auto nearest = SurfaceTree(mesh).closest(seed);
  if (!nearest) return is_reached;
  IdVector<TriId, std::vector<TriId>> neighbors(mesh.num_tris());
  const std::vector<Side> sides = sorted_sides(mesh);
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].ends == sides[begin].ends) ++end;
    if (end - begin != 2) continue;
    const Side &a = sides[begin], &b = sides[begin + 1];
    if (!is_smooth(mesh, a, b, least_cosine)) continue;
    neighbors[a.tri].push_back(b.tri);
    neighbors[b.tri].push_back(a.tri);
  }
  std::vector<TriId> front = {nearest->tri};
  is_reached[nearest->tri.index()] = 1;
  while (!front.empty()) {
    const TriId t = front.back();
    front.pop_back();
    for (TriId other : neighbors[t])
      if (!is_reached[other.index()]) {
        is_reached[other.index()] = 1;
        front.push_back(other);
      }
  }
  return is_reached;
}

}  // namespace hexwright
