// One surface tree per axis direction: a face of the polycube is flat, so the nearest place on it
// is found among facets of its own direction only, and a query at an edge cannot slip around it.
#include "polycube/map/boundary_map.h"

#include <algorithm>

namespace hexwright::polycube {

BoundaryMap::BoundaryMap(const Lattice& lattice) : lattice_(lattice) {
  for (int direction = 0; direction < 6; ++direction) {
    TriMesh part;
    part.positions = lattice.tets.positions;
    for (TriId f : lattice.facets.ids()) {
      if (direction_of(f) != direction) continue;
      part.tris.push_back(lattice.facets[f]);
      facets_[direction].push_back(f);
    }
    trees_.emplace_back(std::move(part));
  }
}

BoundaryMap::Hit BoundaryMap::closest(const Vec3& p, int direction) const {
  const auto hit = trees_[static_cast<std::size_t>(direction)].closest(p);
  return {facets_[direction][hit->tri.index()], hit->point};
}

int BoundaryMap::direction_of(TriId facet) const {
  const Chart& chart = lattice_.charts[static_cast<std::size_t>(lattice_.facet_to_chart[facet])];
  return 2 * chart.axis + (chart.sign > 0 ? 1 : 0);
}

// A facet squeezed to no area in the polycube stands for its first vertex.
// Barycentric coordinates by areas; clamped, because the hit lies in the facet but for rounding,
// and a place outside of it would leave the object's surface.
Vec3 BoundaryMap::carry(const TetMesh& object, const Hit& hit) const {
  const auto& f = lattice_.facets[hit.facet];
  const auto& flat = lattice_.tets.positions;
  const Vec3 &a = flat[f[0]], &b = flat[f[1]], &c = flat[f[2]], &p = hit.point;
  const Vec3 n = cross(b - a, c - a);
  const double area_sq = norm_sq(n);
  if (area_sq <= 0) return object.positions[f[0]];
  const double wa = std::clamp(dot(cross(b - p, c - p), n) / area_sq, 0.0, 1.0);
  const double wb = std::clamp(dot(cross(c - p, a - p), n) / area_sq, 0.0, 1.0 - wa);
  return object.positions[f[0]] * wa + object.positions[f[1]] * wb +
         object.positions[f[2]] * (1 - wa - wb);
}

}  // namespace hexwright::polycube
