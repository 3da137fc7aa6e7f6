// Winding numbers on both sides of a triangle.
#include "hexwright/geometry/exposure.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hexwright {
namespace {

/// Steps off the surface: of the triangle's size, and at most of the surface's diagonal. Small
/// against every wall worth meshing; large against the rounding of positions.
constexpr double kStepOfTriangle = 1e-3;
constexpr double kStepOfDiagonal = 1e-5;
/// How far the probe moves towards the centroid. The way from an edge to the probe stays ten times
/// the step off the surface, which keeps the probe inside wedges down to about 6 degrees.
constexpr double kTowardsCentroid = 0.02;
/// For needles: of the probe's way from the edge it may have started on, a third of the altitude
/// times the above; at least a share of the diagonal that is large against rounding.
constexpr double kStepOfWay = 0.1;
constexpr double kLeastStepOfDiagonal = 1e-10;

/// The probe keeps within `reach` of p.
bool changes_side(const SurfaceTree& surface, TriId t, const Vec3& p, double length,
                  double reach = std::numeric_limits<double>::infinity()) {
  const auto c = surface.surface().corners(t);
  const Vec3 centroid = c[0] * (1.0 / 3) + c[1] * (1.0 / 3) + c[2] * (1.0 / 3);
  Vec3 way = (centroid - p) * kTowardsCentroid;
  if (norm(way) > reach) way *= reach / norm(way);
  const Vec3 probe = p + way;
  const Vec3 step = surface.normal(t) * length;
  return surface.is_inside(probe - step) != surface.is_inside(probe + step);
}

}  // namespace

bool bounds_solid(const SurfaceTree& surface, TriId t, const Vec3& p) {
  const auto c = surface.surface().corners(t);
  const double size = std::sqrt(norm(cross(c[1] - c[0], c[2] - c[0])));
  if (!(size > 0)) return false;
  return changes_side(surface, t, p,
                      std::min(kStepOfTriangle * size, kStepOfDiagonal * surface.box().diagonal()));
}

bool bounds_solid_near(const SurfaceTree& surface, TriId t, const Vec3& p) {
  const auto c = surface.surface().corners(t);
  const double size = std::sqrt(norm(cross(c[1] - c[0], c[2] - c[0])));
  if (!(size > 0)) return false;
  const double step = std::min(kStepOfTriangle * size, kStepOfDiagonal * surface.box().diagonal());
  return changes_side(surface, t, p, step, step / kStepOfWay);
}

bool bounds_solid_closely(const SurfaceTree& surface, TriId t, const Vec3& p) {
  const auto c = surface.surface().corners(t);
  const double longest =
      std::max({distance(c[0], c[1]), distance(c[1], c[2]), distance(c[2], c[0])});
  const double altitude = norm(cross(c[1] - c[0], c[2] - c[0])) / longest;
  if (!(altitude > 0)) return false;  // NaN for a triangle that is a point
  const double diagonal = surface.box().diagonal();
  return changes_side(surface, t, p,
                      std::clamp(kStepOfWay * kTowardsCentroid / 3 * altitude,
                                 kLeastStepOfDiagonal * diagonal, kStepOfDiagonal * diagonal));
}

}  // namespace hexwright
