// The walls of the surface, against the mesh's boundary.
#include "pipeline/loop/thin_misses.h"

#include <cmath>

#include "hexwright/base/parallel.h"
#include "hexwright/geometry/shape_diameter.h"

#include "pipeline/loop/demands.h"

namespace hexwright {
namespace {

/// Volume that is off by less is left to chance; half of what the gate allows.
constexpr double kVolumeCure = 0.01;
/// The same of a wall: each of its two sides may be off by half of that, as a share of its
/// thickness.
constexpr double kThinShare = kVolumeCure / 2;
/// Between samples of the walls, shares of the diagonal: the next where the one before shows
/// nothing, as on a slender rod that was refined wherever a sample was.
constexpr double kSpacings[] = {0.01, 0.003, 0.001};

std::vector<Vec3> find_missed_walls(const RoundInput& input, const SurfaceTree& boundary,
                                    double spacing) {
  const std::vector<WallSample> walls =
      sample_opposite_walls(input.target.tree, spacing, input.context);
  std::vector<char> is_missed(walls.size(), 0);
  parallel_for(walls.size(), [&](std::size_t i) {
    is_missed[i] = std::isfinite(walls[i].inner) &&
                   boundary.distance(walls[i].point) > kThinShare * walls[i].inner;
  });
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < walls.size(); ++i)
    if (is_missed[i]) places.push_back(walls[i].point);
  return places;
}

}  // namespace

std::vector<Vec3> find_thin_misses(const RoundInput& input, const Round& round) {
  if (volume_off(input, round) <= kVolumeCure) return {};
  const SurfaceTree boundary(boundary_triangles(round.fit.mesh));
  std::vector<Vec3> places;
  for (const double spacing : kSpacings) {
    if (!places.empty()) break;
    places = find_missed_walls(input, boundary, spacing * input.target.diagonal());
  }
  return places;
}

}  // namespace hexwright
