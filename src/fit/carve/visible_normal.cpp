#include "fit/carve/visible_normal.h"

namespace hexwright::fitting {
namespace {

struct Least {
  std::size_t index = 0;
  double value = 2;
};

Least least_dot(std::span<const Vec3> normals, const Vec3& d) {
  Least least;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const double value = dot(normals[i], d);
    if (value < least.value) least = {i, value};
  }
  return least;
}

}  // namespace

VisibleDirection find_visible_direction(std::span<const Vec3> normals, double enough) {
  Vec3 sum;
  for (const Vec3& n : normals) sum += n;
  VisibleDirection best;
  best.direction = norm(sum) < 1e-9 ? normals[0] : normalized(sum);
  best.cosine = least_dot(normals, best.direction).value;
  // z runs towards the hull's point nearest to the origin: at each step the best point of the
  // segment from z to the normal that z sees worst. It starts and stays in the hull.
  Vec3 z = sum / static_cast<double>(normals.size());
  for (int step = 0; step < 40 && best.cosine < enough; ++step) {
    const Vec3 e = normals[least_dot(normals, z).index] - z;
    const double length_sq = norm_sq(e);
    if (length_sq < 1e-14) break;
    const double t = std::clamp(-dot(z, e) / length_sq, 0.0, 1.0);
    if (t < 1e-6) break;
    z += t * e;
    if (norm(z) < 1e-4) break;  // the origin is in the hull: no direction sees all
    const Vec3 d = normalized(z);
    const double cosine = least_dot(normals, d).value;
    if (cosine > best.cosine) best = {d, cosine};
  }
  return best;
}

}  // namespace hexwright::fitting
