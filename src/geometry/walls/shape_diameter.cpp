// Shape diameter of every triangle: rays in a cone about the inward normal, outliers removed,
// weighted mean.
//
// Based on: Shapira, Shamir, Cohen-Or 2008, section 3.1.
#include "hexwright/geometry/shape_diameter.h"

#include <algorithm>
#include <limits>

#include "hexwright/base/parallel.h"

#include "geometry/walls/ray_scene.h"

namespace hexwright {
namespace {

/// Walls whose normals agree more than this are on the ray's own side; perpendicular ones count.
constexpr double kSameSide = 1e-6;

struct WeightedLength {
  double length, weight;
};

/// Mean of the lengths within one standard deviation of the median, by weight.
double robust_mean(std::vector<WeightedLength>& lengths) {
  if (lengths.empty()) return std::numeric_limits<double>::infinity();
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end(),
                   [](const auto& a, const auto& b) { return a.length < b.length; });
  const double median = middle->length;
  // Relative to the median, so that squares neither overflow nor vanish.
  if (!(median > 0)) return 0;
  double mean = 0, variance = 0;
  for (const auto& l : lengths) mean += l.length / median / double(lengths.size());
  for (const auto& l : lengths) {
    const double d = l.length / median - mean;
    variance += d * d / double(lengths.size());
  }
  const double spread = std::sqrt(variance) + 1e-12;
  double sum = 0, weight = 0;
  for (const auto& l : lengths) {
    if (std::abs(l.length / median - 1) > spread) continue;
    sum += l.length / median * l.weight;
    weight += l.weight;
  }
  return weight > 0 ? sum / weight * median : median;
}

}  // namespace

IdVector<TriId, double> compute_shape_diameter(const SurfaceTree& tree,
                                               const ShapeDiameterOptions& options,
                                               const Context& context) {
  const auto watch = context.watch();
  if (options.num_rays < 1 || !(options.cone_angle > 0) ||
      !(options.cone_angle <= std::numbers::pi))
    throw Error(ErrorCode::BadArgument,
                "the shape diameter needs at least one ray and a cone of at most pi");
  const TriMesh& surface = tree.surface();
  const auto cone = spread_cone(options.num_rays, options.cone_angle / 2);
  IdVector<TriId, double> diameter(surface.num_tris(), std::numeric_limits<double>::infinity());
  parallel_chunks(surface.num_tris(), 256, [&](std::size_t begin, std::size_t end) {
    context.check_cancelled();
    std::vector<WeightedLength> lengths;
    for (std::size_t i = begin; i < end; ++i) {
      const TriId t(i);
      const Vec3 n = tree.normal(t);
      if (n == Vec3{}) continue;
      const auto c = surface.corners(t);
      const Vec3 from = (c[0] + c[1] + c[2]) / 3;
      const AxisFrame inwards(-n);
      lengths.clear();
      for (const ConeRay& ray : cone) {
        const auto hit = first_wall(tree, from, t, inwards.to_world(ray.direction));
        if (hit && dot(tree.normal(hit->tri), n) <= kSameSide)
          lengths.push_back({hit->length, 1 / ray.angle});
      }
      diameter[t] = robust_mean(lengths);
    }
  });
  return diameter;
}

IdVector<TriId, double> compute_shape_diameter(const TriMesh& surface,
                                               const ShapeDiameterOptions& options,
                                               const Context& context) {
  const Similarity frame = compute_unit_frame(surface);
  auto diameter = compute_shape_diameter(SurfaceTree(to_unit(surface, frame)), options, context);
  for (double& d : diameter) d = frame.length_to_world(d);
  return diameter;
}

}  // namespace hexwright
