// The direction sought points to the minimum-norm point of the normals' convex hull.
//
// Based on: Gilbert, "An iterative procedure for computing the minimum of a quadratic form on a
// convex set", SIAM J. Control 4(1), 1966.
#include "fit/visible_direction.h"

#include <algorithm>

namespace hexwright::fitting {
namespace {

constexpr int kMaxSteps = 40;
constexpr double kGoodEnough = 0.95;  // the mean direction is kept as it is from this cosine on

std::size_t most_opposed(std::span<const Vec3> normals, const Vec3& d) {
  std::size_t worst = 0;
  for (std::size_t i = 1; i < normals.size(); ++i)
    if (dot(normals[i], d) < dot(normals[worst], d)) worst = i;
  return worst;
}

double least_cosine(std::span<const Vec3> normals, const Vec3& d) {
  return dot(normals[most_opposed(normals, d)], d);
}

}  // namespace

SheetDirection find_sheet_direction(std::span<const Vec3> normals) {
  if (normals.empty()) return {};
  Vec3 sum;
  for (const Vec3& n : normals) sum += n;
  SheetDirection best;
  best.direction = norm(sum) < 1e-9 ? normals[0] : normalized(sum);
  best.cosine = least_cosine(normals, best.direction);
  if (best.cosine >= kGoodEnough) return best;
  Vec3 z = sum / static_cast<double>(normals.size());  // in the hull, as every later point
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vec3 toward = normals[most_opposed(normals, z)] - z;
    const double length_sq = norm_sq(toward);
    if (length_sq < 1e-14) break;
    const double t = std::clamp(-dot(z, toward) / length_sq, 0.0, 1.0);
    if (t < 1e-6) break;
    z += toward * t;
    if (norm(z) < 1e-4) break;  // the hull holds the origin
    const Vec3 d = normalized(z);
    const double cosine = least_cosine(normals, d);
    if (cosine > best.cosine) best = {d, cosine};
  }
  return best;
}

}  // namespace hexwright::fitting
