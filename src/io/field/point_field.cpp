// Trilinear between the points of a lattice.
#include "hexwright/io/point_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "hexwright/base/error.h"

namespace hexwright {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-9;  // of a step

/// Places become coordinates in steps.
class Lattice {
 public:
  Lattice(const PointLattice& lattice, std::vector<double> values)
      : lattice_(lattice), values_(std::move(values)) {
    const auto& [a, b, c] = lattice_.steps;
    const double volume = det(a, b, c);
    if (!(std::abs(volume) > 0) || !std::isfinite(volume))
      throw Error(
          ErrorCode::BadArgument,
          "the steps of the lattice lie in a plane; give three directions with room between "
          "them");
    to_steps_ = {cross(b, c) / volume, cross(c, a) / volume, cross(a, b) / volume};
  }

  std::vector<Vec3> points() const {
    std::vector<Vec3> points;
    points.reserve(values_.size());
    const auto& [a, b, c] = lattice_.steps;
    for (std::size_t k = 0; k < lattice_.counts[2]; ++k)
      for (std::size_t j = 0; j < lattice_.counts[1]; ++j)
        for (std::size_t i = 0; i < lattice_.counts[0]; ++i)
          points.push_back(lattice_.origin + a * static_cast<double>(i) +
                           b * static_cast<double>(j) + c * static_cast<double>(k));
    return points;
  }

  double at(const Vec3& place) const {
    std::array<std::size_t, 3> low = {0, 0, 0};
    std::array<double, 3> share = {0, 0, 0};
    for (std::size_t d = 0; d < 3; ++d) {
      const double steps = dot(to_steps_[d], place - lattice_.origin);
      const auto last = static_cast<double>(lattice_.counts[d] - 1);
      if (!(steps >= -kRounding && steps <= last + kRounding)) return kNowhere;
      const double inside = std::clamp(steps, 0.0, last);
      const double first = std::min(std::floor(inside), std::max(0.0, last - 1));
      low[d] = static_cast<std::size_t>(first);
      share[d] = inside - first;
    }
    return interpolate(low, share);
  }

  const std::vector<double>& values() const { return values_; }

 private:
  /// Corners without a share do not count, whatever is there.
  double interpolate(const std::array<std::size_t, 3>& low,
                     const std::array<double, 3>& share) const {
    double sum = 0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      double weight = 1;
      std::size_t at = 0, stride = 1;
      for (std::size_t d = 0; d < 3; ++d) {
        const bool is_high = corner >> d & 1;
        weight *= is_high ? share[d] : 1 - share[d];
        at += (low[d] + is_high) * stride;
        stride *= lattice_.counts[d];
      }
      if (weight > 0) sum += weight * values_[at];
    }
    return sum;
  }

  PointLattice lattice_;
  std::vector<double> values_;
  std::array<Vec3, 3> to_steps_;
};

}  // namespace

PointField make_lattice_field(const PointLattice& lattice, std::vector<double> values) {
  // In doubles: counts of damaged files have products beyond any integer.
  double num_points = 1;
  for (std::size_t count : lattice.counts) num_points *= static_cast<double>(count);
  if (num_points != static_cast<double>(values.size()) || values.empty())
    throw Error(
        ErrorCode::BadArgument,
        fmt::format("a lattice of {} x {} x {} points has {} values; give one per point",
                    lattice.counts[0], lattice.counts[1], lattice.counts[2], values.size()));
  const auto shared = std::make_shared<const Lattice>(lattice, std::move(values));
  return {shared->points(), shared->values(),
          [shared](std::span<const Vec3> places, std::span<double> numbers) {
            std::transform(places.begin(), places.end(), numbers.begin(),
                           [&](const Vec3& p) { return shared->at(p); });
          }};
}

}  // namespace hexwright
