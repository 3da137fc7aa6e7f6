// Points in a plane, found near a triangle.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "hexwright/base/function_ref.h"

#include "base/box_tree.h"

namespace hexwright::io {

/// A point in the coordinates of a plane, and the caller's number for it.
struct PlanePoint {
  double u = 0, v = 0;
  std::uint32_t index = 0;
};

/// A plane through `origin`; coordinates run counter-clockwise seen from where `normal` points.
struct Plane {
  Vec3 origin, normal;  ///< the normal as given, of any length
  Vec3 along_u, along_v;

  Plane(const Vec3& through, const Vec3& across) : origin(through), normal(across) {
    const Vec3 n = normalized(across);
    const Vec3 axis = std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    along_u = normalized(cross(axis, n));
    along_v = cross(n, along_u);
  }
  /// False where the normal is zero or not finite: points have no coordinates then.
  bool is_proper() const { return norm_sq(along_v) > 0.5 && norm_sq(along_u) > 0.5; }
  PlanePoint project(const Vec3& p, std::uint32_t index) const {
    const Vec3 d = p - origin;
    return {dot(d, along_u), dot(d, along_v), index};
  }
};

/// Points that do not change and a tree over them.
class PlaneTree {
 public:
  PlaneTree() = default;
  explicit PlaneTree(std::vector<PlanePoint> points);

  /// Calls `accept` for points in or near a counter-clockwise triangle until it returns true; true
  /// when it did. Leaves out no point inside; what is near is the caller's to decide.
  bool find_near(const std::array<PlanePoint, 3>& triangle,
                 FunctionRef<bool(std::uint32_t index)> accept) const;

 private:
  std::vector<PlanePoint> points_;
  BoxTree tree_;  // over points_, as boxes without height
};

}  // namespace hexwright::io
