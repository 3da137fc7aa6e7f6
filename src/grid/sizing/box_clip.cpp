// Clips triangles and segments to a cube about the origin.
//
// Based on: Sutherland, Hodgman, "Reentrant polygon clipping", CACM 17(1), 1974.
#include "grid/sizing/box_clip.h"

#include <algorithm>
#include <utility>

namespace hexwright::grids {
namespace {

/// Keeps the part of the polygon with sign * coordinate <= half on one axis.
void clip_to_plane(const ClippedPolygon& in, int axis, double sign, double half,
                   ClippedPolygon& out) {
  out.count = 0;
  for (int i = 0; i < in.count; ++i) {
    const Vec3& p = in.points[static_cast<std::size_t>(i)];
    const Vec3& q = in.points[static_cast<std::size_t>(i + 1 == in.count ? 0 : i + 1)];
    const double dp = half - sign * p[axis], dq = half - sign * q[axis];
    if (dp >= 0) out.points[static_cast<std::size_t>(out.count++)] = p;
    if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0))
      out.points[static_cast<std::size_t>(out.count++)] = p + (q - p) * (dp / (dp - dq));
  }
}

}  // namespace

ClippedPolygon clip_to_cube(const std::array<Vec3, 3>& tri, double half) {
  ClippedPolygon a{{tri[0], tri[1], tri[2]}, 3}, b;
  const Vec3 lo = min(tri[0], min(tri[1], tri[2])), hi = max(tri[0], max(tri[1], tri[2]));
  for (int axis = 0; axis < 3; ++axis) {
    if (lo[axis] > half || hi[axis] < -half) return {};
    if (hi[axis] > half) {
      clip_to_plane(a, axis, 1, half, b);
      std::swap(a, b);
    }
    if (lo[axis] < -half) {
      clip_to_plane(a, axis, -1, half, b);
      std::swap(a, b);
    }
  }
  return a;
}

bool meets_cube(const std::array<Vec3, 3>& tri, double half) {
  if (in_cube(tri[0], half) || in_cube(tri[1], half) || in_cube(tri[2], half)) return true;
  return clip_to_cube(tri, half).count > 0;
}

bool segment_meets_cube(const Vec3& a, const Vec3& b, double half) {
  double t0 = 0, t1 = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = b[axis] - a[axis];
    if (d == 0) {
      if (std::abs(a[axis]) > half) return false;
      continue;
    }
    double near = (-half - a[axis]) / d, far = (half - a[axis]) / d;
    if (near > far) std::swap(near, far);
    t0 = std::max(t0, near);
    t1 = std::min(t1, far);
  }
  return t0 <= t1;
}

}  // namespace hexwright::grids
