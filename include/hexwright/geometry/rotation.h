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

}  // namespace hexwright
