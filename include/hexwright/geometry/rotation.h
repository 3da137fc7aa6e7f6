// A rotation about the origin, as the three axes of the turned frame.
#pragma once

#include <array>

#include "hexwright/base/vec3.h"

namespace hexwright {

/// Rows are the turned frame's axes in the given frame: right-handed, orthonormal to rounding. The
/// identity keeps every bit.
struct Rotation {
  std::array<Vec3, 3> axes = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

  bool is_identity() const { return axes == Rotation{}.axes; }
  /// Given frame to turned frame.
  Vec3 apply(const Vec3& p) const {
    if (is_identity()) return p;
    return {dot(axes[0], p), dot(axes[1], p), dot(axes[2], p)};
  }
  /// Turned frame to given frame.
  Vec3 apply_inverse(const Vec3& p) const {
    if (is_identity()) return p;
    return axes[0] * p.x + axes[1] * p.y + axes[2] * p.z;
  }
};

/// The rotation that does `first` and then `second`.
inline Rotation compose(const Rotation& first, const Rotation& second) {
  if (first.is_identity()) return second;
  Rotation both;
  for (int a = 0; a < 3; ++a) both.axes[a] = first.apply_inverse(second.axes[a]);
  return both;
}

}  // namespace hexwright
