#include "polycube/lattice/axis_scales.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hexwright::polycube {
namespace {

constexpr int kMostCubesPerAxis = 16;  // of a derived spacing

double extent_of(const AxisPlanes& planes) {
  double extent = 0;
  for (const auto& p : planes) extent = std::max(extent, p.back() - p.front());
  return extent;
}

}  // namespace

std::size_t AxisScale::piece(double x) const {
  const auto above =
      static_cast<std::size_t>(std::upper_bound(from.begin(), from.end(), x) - from.begin());
  return std::clamp<std::size_t>(above, 1, from.size() - 1) - 1;
}

double AxisScale::slope(double x) const {
  const std::size_t i = piece(x);
  return (to[i + 1] - to[i]) / (from[i + 1] - from[i]);
}

// From the nearer end, so that knots go exactly where they belong.
double AxisScale::operator()(double x) const {
  const std::size_t i = piece(x);
  const double t = (x - from[i]) / (from[i + 1] - from[i]);
  return t < 0.5 ? to[i] + t * (to[i + 1] - to[i]) : to[i + 1] - (1 - t) * (to[i + 1] - to[i]);
}

double geometric_spacing(const AxisPlanes& planes) {
  const double extent = extent_of(planes);
  double least = extent;
  for (const auto& p : planes)
    for (std::size_t i = 1; i < p.size(); ++i) least = std::min(least, p[i] - p[i - 1]);
  return std::max(least, extent / kMostCubesPerAxis);
}

bool is_within_limit(const AxisScales& scales) {
  constexpr double kMostRoots = 1000;  // per axis
  return std::all_of(scales.begin(), scales.end(),
                     [](const AxisScale& scale) { return scale.to.back() <= kMostRoots; });
}

AxisScales even_scales(const AxisPlanes& planes, double spacing) {
  AxisScales scales;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    AxisScale& scale = scales[axis];
    scale.from = planes[axis];
    scale.to = {0};
    for (std::size_t i = 1; i < scale.from.size(); ++i)
      scale.to.push_back(scale.to.back() +
                         std::max(1.0, std::round((scale.from[i] - scale.from[i - 1]) / spacing)));
  }
  return scales;
}

}  // namespace hexwright::polycube
