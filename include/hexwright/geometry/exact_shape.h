// The exact shape that a triangle surface stands for, as far as a mesher asks for it.
#pragma once

#include <optional>

#include "hexwright/base/vec3.h"

namespace hexwright {

/// A point of the exact shape.
struct ExactPoint {
  Vec3 point;
  Vec3 direction;  ///< unit: of a surface its outward normal, of a curve its tangent
};

/// All points are in the coordinates of the surface as it was given. Calls need not be safe from
/// several threads at once. Answers are absent where the shape has nothing near, or where the
/// projection fails.
class ExactShape {
 public:
  virtual ~ExactShape() = default;
  /// The point of the surface nearest to p, on the face whose triangles are nearest among those
  /// that face along `normal` (unit, outwards); a zero normal admits all.
  virtual std::optional<ExactPoint> on_surface(const Vec3& p, const Vec3& normal) const = 0;
  /// The point nearest to p of the curves that are features.
  virtual std::optional<ExactPoint> on_curve(const Vec3& p) const = 0;
  /// The nearest end of a curve.
  virtual std::optional<Vec3> on_corner(const Vec3& p) const = 0;
};

}  // namespace hexwright
