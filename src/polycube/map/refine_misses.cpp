// From points of the object back to cells of the polycube, through the same tets as the way there.
#include "polycube/map/refine_misses.h"

#include "hexwright/base/parallel.h"
#include "hexwright/grid/sizing.h"

namespace hexwright::polycube {
namespace {

// Far below a cell's edge, far above rounding. Cells are half-open: a point exactly on the domain's
// upper faces is in none.
constexpr double kInward = 1e-6;

}  // namespace

std::vector<char> mark_cells_of_object_points(const Grid& grid, std::span<const Vec3> points,
                                              const TetLocator& in_object, const Lattice& lattice,
                                              int max_level) {
  std::vector<Vec3> places(points.size());
  parallel_for(
      points.size(),
      [&](std::size_t i) {
        TetPoint at = in_object.locate(points[i]);
        // Towards the tet's centroid: off the domain's boundary, wherever that looks.
        for (double& w : at.weight) w += kInward * (0.25 - w);
        places[i] = interpolate(lattice.tets, at);
      },
      64);
  return mark_cells_with_points(grid, places, max_level);
}

IdVector<VertId, Vec3> inward_places(const TetMesh& polycube) {
  IdVector<VertId, Vec3> sum(polycube.num_verts());
  IdVector<VertId, int> count(polycube.num_verts(), 0);
  for (TetId t : polycube.tets.ids()) {
    Vec3 center;
    for (VertId v : polycube.tets[t]) center += polycube.positions[v] * 0.25;
    for (VertId v : polycube.tets[t]) {
      sum[v] += center;
      ++count[v];
    }
  }
  IdVector<VertId, Vec3> places = polycube.positions;
  for (VertId v : places.ids())
    if (count[v] > 0) places[v] += kInward * (sum[v] / count[v] - places[v]);
  return places;
}

}  // namespace hexwright::polycube
