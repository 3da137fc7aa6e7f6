// Rays leave from triangles, so the first hits may be the source itself and are passed.
#include "geometry/walls/ray_scene.h"

#include <cmath>
#include <numbers>

namespace hexwright {

std::optional<RayHit> first_wall(const SurfaceTree& tree, const Vec3& from, TriId source,
                                 const Vec3& direction) {
  // Hits nearer than this on triangles that face like the source are the source's own plane: folds
  // of a surface that is not quite clean.
  constexpr double kSelfHit = 1e-5;
  const Vec3& n = tree.normal(source);
  return tree.first_hit(from, direction, [&](const RayHit& hit) {
    if (hit.tri == source || tree.normal(hit.tri) == Vec3{}) return false;
    return !(hit.length < kSelfHit && dot(tree.normal(hit.tri), n) >= 0);
  });
}

std::vector<ConeRay> spread_cone(int num_rays, double half_angle) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  const double depth = 1 - std::cos(half_angle);
  std::vector<ConeRay> rays;
  for (int i = 0; i < num_rays; ++i) {
    // Equal parts of the cap's area; the half step keeps every ray off the axis and the rim.
    const double z = 1 - depth * (i + 0.5) / num_rays;
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    rays.push_back({{r * std::cos(golden * i), r * std::sin(golden * i), z}, std::acos(z)});
  }
  return rays;
}

AxisFrame::AxisFrame(const Vec3& n) : z(n) {
  const Vec3 helper = std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  x = normalized(cross(helper, n));
  y = cross(n, x);
}

}  // namespace hexwright
