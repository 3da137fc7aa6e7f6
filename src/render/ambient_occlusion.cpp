// Based on: McGuire, Osman, Bukowski, Hennessy, "The Alchemy Screen-Space Ambient Obscurance
// Algorithm", High Performance Graphics 2011, equation 10.
// Differs: one spiral of samples for all pixels, which needs no blur, since it has enough of them.
#include "render/ambient_occlusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hexwright/base/parallel.h"

namespace hexwright {
namespace {

constexpr int kNumSamples = 40;
constexpr double kRadius = 0.06;    // scene diagonals
constexpr double kStrength = 0.75;  // share of light a corner may lose
constexpr double kBias = 0.02;      // share of the radius: a plane does not shade itself

struct Offset {
  double x = 0, y = 0;  // in the unit disc
};

// Evenly over the disc: equal areas per sample, turned by the golden angle.
std::vector<Offset> make_spiral() {
  constexpr double kGoldenAngle = std::numbers::pi * (3 - 2.2360679774997896);
  std::vector<Offset> offsets;
  for (int i = 0; i < kNumSamples; ++i) {
    const double radius = std::sqrt((i + 0.5) / kNumSamples);
    offsets.push_back({radius * std::cos(i * kGoldenAngle), radius * std::sin(i * kGoldenAngle)});
  }
  return offsets;
}

// The position seen at a pixel, in the camera's frame and units of scene diagonals. The image's
// middle stands for the optical axis, near enough for shading.
Vec3 view_position(const Raster& raster, int x, int y, double focal_length) {
  const double distance = 1 / static_cast<double>(raster.nearness[raster.at(x, y)]);
  return {(x - 0.5 * raster.width) * distance / focal_length,
          -(y - 0.5 * raster.height) * distance / focal_length, -distance};
}

// Sum over the samples of how much of the hemisphere over the pixel they fill: v . n / (v . v), as
// in the paper's estimator. Samples beyond the image or on the background fill nothing.
double occlusion_at(const Raster& raster, int x, int y, double focal_length,
                    const std::vector<Offset>& spiral) {
  const Vec3 p = view_position(raster, x, y, focal_length);
  const Vec3& normal = raster.normal[raster.at(x, y)];
  const double radius_px = kRadius * focal_length * raster.nearness[raster.at(x, y)];
  double sum = 0;
  for (const Offset& offset : spiral) {
    const int sx = x + static_cast<int>(std::lround(offset.x * radius_px));
    const int sy = y + static_cast<int>(std::lround(offset.y * radius_px));
    if (sx < 0 || sy < 0 || sx >= raster.width || sy >= raster.height) continue;
    if (raster.nearness[raster.at(sx, sy)] <= 0) continue;
    const Vec3 v = view_position(raster, sx, sy, focal_length) - p;
    if (norm_sq(v) > 4 * kRadius * kRadius) continue;  // something far in front
    sum +=
        std::max(0.0, dot(v, normal) - kBias * kRadius) / (norm_sq(v) + 1e-4 * kRadius) * kRadius;
  }
  return std::min(1.0, 1.6 * sum / kNumSamples);
}

}  // namespace

void apply_ambient_occlusion(Raster& raster, double focal_length) {
  const std::vector<Offset> spiral = make_spiral();
  parallel_for(
      static_cast<std::size_t>(raster.height),
      [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < raster.width; ++x) {
          const std::size_t pixel = raster.at(x, y);
          if (raster.nearness[pixel] <= 0) continue;
          const double occlusion = occlusion_at(raster, x, y, focal_length, spiral);
          raster.color[pixel] = static_cast<float>(1 - kStrength * occlusion) * raster.color[pixel];
        }
      },
      8);
}

}  // namespace hexwright
