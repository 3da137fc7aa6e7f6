// Validity of elements of second order, by adaptive subdivision.
//
// Based on: Johnen, Remacle, Geuzaine 2013.
#include <algorithm>
#include <cmath>

#include "hexwright/base/parallel.h"
#include "hexwright/quality/hex_quality.h"

#include "quality/jacobian/quadratic_jacobian.h"

namespace hexwright {
namespace {

// Rounding error allowed for in the coefficients, relative to the cube of the element's extent.
constexpr double kRounding = 1e-13;
constexpr int kMaxDepth = 4;

constexpr std::array<std::size_t, 8> kCorners = {0, 5, 30, 35, 180, 185, 210, 215};

Positivity check_bezier(const QuadraticBezier& b, double floor, double tolerance, int depth) {
  for (std::size_t corner : kCorners)
    if (b[corner] <= floor) return Positivity::NotPositive;
  if (*std::min_element(b.begin(), b.end()) > floor + tolerance) return Positivity::Positive;
  if (depth == kMaxDepth) return Positivity::Undecided;
  bool is_decided = true;
  for (const QuadraticBezier& part : subdivide(b)) {
    const Positivity result = check_bezier(part, floor, tolerance, depth + 1);
    if (result == Positivity::NotPositive) return result;
    is_decided = is_decided && result == Positivity::Positive;
  }
  return is_decided ? Positivity::Positive : Positivity::Undecided;
}

double tolerance_of(const QuadraticHex& nodes) {
  Box3 box;
  for (const Vec3& p : nodes) box.extend(p);
  return kRounding * std::pow(box.diagonal(), 3);
}

/// Whether a node is off the middle of what it belongs to by more than rounding.
bool is_curved(const QuadraticHex& nodes) {
  QuadraticHex straight = nodes;
  double size_sq = 0;
  for (std::size_t le = 0; le < 12; ++le) {
    const Vec3 &a = nodes[static_cast<std::size_t>(kHexEdges[le][0])],
               &b = nodes[static_cast<std::size_t>(kHexEdges[le][1])];
    straight[8 + le] = 0.5 * a + 0.5 * b;
    size_sq = std::max(size_sq, norm_sq(b - a));
  }
  fill_inner_nodes(straight);
  for (std::size_t n = 8; n < 27; ++n)
    if (norm_sq(nodes[n] - straight[n]) > 1e-20 * size_sq) return true;
  return false;
}

void add_hex(SecondOrderQuality& summary, HexId h, const QuadraticHex& nodes) {
  if (is_curved(nodes)) ++summary.num_curved;
  const QuadraticBezier bezier = compute_quadratic_bezier(nodes);
  const double volume = volume_of(bezier);
  summary.total_volume += volume;
  const auto at_nodes = jacobians_at_nodes(nodes);
  const double least = *std::min_element(at_nodes.begin(), at_nodes.end());
  const double share = volume > 0 ? least / volume : -1;
  if (!summary.worst_hex.is_valid() || share < summary.min_jacobian_share) {
    summary.worst_hex = h;
    summary.min_jacobian_share = share;
  }
  const Positivity positivity =
      least <= 0 ? Positivity::NotPositive : check_bezier(bezier, 0, tolerance_of(nodes), 0);
  if (positivity == Positivity::Undecided) ++summary.num_undecided;
  if (positivity != Positivity::NotPositive) return;
  ++summary.num_not_positive;
  if (summary.broken.size() < SecondOrderQuality::kMaxListed) summary.broken.push_back(h);
}

SecondOrderQuality combine(SecondOrderQuality a, const SecondOrderQuality& b) {
  if (!b.worst_hex.is_valid()) return a;
  if (!a.worst_hex.is_valid() || b.min_jacobian_share < a.min_jacobian_share) {
    a.worst_hex = b.worst_hex;
    a.min_jacobian_share = b.min_jacobian_share;
  }
  a.num_curved += b.num_curved;
  a.num_not_positive += b.num_not_positive;
  a.num_undecided += b.num_undecided;
  a.total_volume += b.total_volume;
  for (HexId h : b.broken)
    if (a.broken.size() < SecondOrderQuality::kMaxListed) a.broken.push_back(h);
  return a;
}

}  // namespace

Positivity check_positivity(const QuadraticHex& nodes, double floor) {
  return check_bezier(compute_quadratic_bezier(nodes), floor, tolerance_of(nodes), 0);
}

SecondOrderQuality summarize_second_order(const HexMesh& mesh) {
  const auto summarize_chunk = [&](std::size_t begin, std::size_t end) {
    SecondOrderQuality chunk;
    for (std::size_t i = begin; i < end; ++i)
      add_hex(chunk, HexId(i), quadratic_hex(mesh, HexId(i)));
    return chunk;
  };
  return parallel_reduce(mesh.num_hexes(), SecondOrderQuality{}, summarize_chunk, combine, 256);
}

}  // namespace hexwright
