// A perspective camera far enough away that everything is in front of it.
#pragma once

#include <span>

#include "hexwright/base/vec3.h"

namespace hexwright {

/// Where a point appears: pixels from the image's top left, and a depth that grows towards the eye
/// and is linear on the screen along any plane.
struct ScreenPoint {
  double x = 0, y = 0;
  double nearness = 0;  ///< 1 / distance along the view axis, in units of the scene's diagonal
};

struct Viewport {
  double left = 0, top = 0, width = 0, height = 0;  ///< pixels
};

class Camera {
 public:
  /// Looks along `direction` with z up, and frames the points in the viewport.
  Camera(std::span<const Vec3> points, const Vec3& direction, const Viewport& viewport);

  ScreenPoint project(const Vec3& p) const;
  /// A direction in the frame (right, up, towards the eye).
  Vec3 to_view(const Vec3& v) const { return {dot(v, right_), dot(v, up_), -dot(v, forward_)}; }
  /// Pixels per scene diagonal at unit nearness.
  double focal_length() const { return scale_; }

 private:
  ScreenPoint project_unscaled(const Vec3& p) const;

  Vec3 eye_, right_, up_, forward_;
  double unit_ = 1;  // the scene's diagonal
  double scale_ = 1, shift_x_ = 0, shift_y_ = 0;
};

}  // namespace hexwright
