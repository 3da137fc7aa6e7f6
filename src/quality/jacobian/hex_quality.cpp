// Quality of one hex, and its summary over a mesh.
//
// Based on: Johnen, Weill, Remacle 2017 (positivity).
#include "hexwright/quality/hex_quality.h"

#include <algorithm>
#include <cmath>

#include "hexwright/base/parallel.h"

#include "quality/jacobian/bezier_jacobian.h"

namespace hexwright {
namespace {

// Rounding error allowed for in the Bezier coefficients, relative to the product of the longest
// edges.
constexpr double kRounding = 1e-14;
constexpr int kMaxDepth = 5;

// Longest edge of each axis, multiplied: a bound of what the coefficients are differences of.
double product_of_longest_edges(const std::array<Vec3, 8>& p) {
  std::array<double, 3> longest_sq{};
  for (std::size_t e = 0; e < 12; ++e) {
    const std::size_t axis = e >= 8 ? 2 : e % 2;  // rings alternate between x and y
    longest_sq[axis] = std::max(longest_sq[axis], norm_sq(p[kHexEdges[e][1]] - p[kHexEdges[e][0]]));
  }
  return std::sqrt(longest_sq[0]) * std::sqrt(longest_sq[1]) * std::sqrt(longest_sq[2]);
}

// The corners are values of the polynomial, the other coefficients only bound it.
bool has_nonpositive_corner(const JacobianBezier& b) {
  for (std::size_t corner : {0, 2, 6, 8, 18, 20, 24, 26})
    if (b[corner] <= 0) return true;
  return false;
}

Positivity check_bezier(const JacobianBezier& b, double tolerance, int depth) {
  if (has_nonpositive_corner(b)) return Positivity::NotPositive;
  if (*std::min_element(b.begin(), b.end()) > tolerance) return Positivity::Positive;
  if (depth == kMaxDepth) return Positivity::Undecided;
  bool is_decided = true;
  for (const JacobianBezier& part : subdivide(b)) {
    const Positivity result = check_bezier(part, tolerance, depth + 1);
    if (result == Positivity::NotPositive) return result;
    is_decided = is_decided && result == Positivity::Positive;
  }
  return is_decided ? Positivity::Positive : Positivity::Undecided;
}

void add_hex(QualitySummary& summary, HexId h, const std::array<Vec3, 8>& p) {
  const double value = scaled_jacobian(p);
  if (!summary.worst_hex.is_valid() || value < summary.min_scaled_jacobian) {
    summary.worst_hex = h;
    summary.min_scaled_jacobian = value;
  }
  ++summary.num_hexes;
  summary.avg_scaled_jacobian += value;  // a sum until the end
  if (value <= 0) ++summary.num_inverted;
  const double bin = std::clamp(std::floor((value + 1) * 10), 0.0, 19.0);
  ++summary.histogram[static_cast<std::size_t>(bin)];
  const Positivity positivity = check_positivity(p);
  if (positivity == Positivity::NotPositive) ++summary.num_not_positive;
  if (positivity == Positivity::Undecided) ++summary.num_undecided;
  summary.total_volume += hex_volume(p);
}

QualitySummary combine(QualitySummary a, const QualitySummary& b) {
  if (b.num_hexes == 0) return a;
  if (a.num_hexes == 0 || b.min_scaled_jacobian < a.min_scaled_jacobian) {
    a.worst_hex = b.worst_hex;
    a.min_scaled_jacobian = b.min_scaled_jacobian;
  }
  a.num_hexes += b.num_hexes;
  a.num_inverted += b.num_inverted;
  a.avg_scaled_jacobian += b.avg_scaled_jacobian;
  for (std::size_t i = 0; i < a.histogram.size(); ++i) a.histogram[i] += b.histogram[i];
  a.num_not_positive += b.num_not_positive;
  a.num_undecided += b.num_undecided;
  a.total_volume += b.total_volume;
  return a;
}

}  // namespace

Positivity check_positivity(const std::array<Vec3, 8>& p) {
  const JacobianBezier b = compute_jacobian_bezier(p);
  return check_bezier(b, kRounding * product_of_longest_edges(p), 0);
}

QualitySummary summarize_quality(const HexMesh& mesh) {
  const auto summarize_chunk = [&](std::size_t begin, std::size_t end) {
    QualitySummary chunk;
    for (std::size_t i = begin; i < end; ++i) add_hex(chunk, HexId(i), mesh.corners(HexId(i)));
    return chunk;
  };
  QualitySummary total =
      parallel_reduce(mesh.num_hexes(), QualitySummary{}, summarize_chunk, combine);
  if (total.num_hexes > 0) total.avg_scaled_jacobian /= static_cast<double>(total.num_hexes);
  return total;
}

IdVector<HexId, double> compute_scaled_jacobians(const HexMesh& mesh) {
  IdVector<HexId, double> result(mesh.num_hexes());
  parallel_for(mesh.num_hexes(),
               [&](std::size_t h) { result[HexId(h)] = scaled_jacobian(mesh.corners(HexId(h))); });
  return result;
}

}  // namespace hexwright
