#include "mesh/tri_measures.h"

namespace hexwright {

double enclosed_volume(const TriMesh& surface) {
  if (surface.num_tris() == 0) return 0;
  const Vec3 origin = surface.corners(TriId(0))[0];
  double volume6 = 0;
  for (TriId t : surface.tris.ids()) {
    const auto c = surface.corners(t);
    volume6 += det(c[0] - origin, c[1] - origin, c[2] - origin);
  }
  return volume6 / 6;
}

double total_area(const TriMesh& surface) {
  double area2 = 0;
  for (TriId t : surface.tris.ids()) {
    const auto c = surface.corners(t);
    area2 += norm(cross(c[1] - c[0], c[2] - c[0]));
  }
  return area2 / 2;
}

void append(TriMesh& to, const TriMesh& from) {
  const std::size_t base = to.num_verts();
  for (const Vec3& p : from.positions) to.positions.push_back(p);
  for (const auto& t : from.tris)
    to.tris.push_back(
        {VertId(base + t[0].index()), VertId(base + t[1].index()), VertId(base + t[2].index())});
}

}  // namespace hexwright
