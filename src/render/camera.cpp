// Pinhole projection: directions are measured in units of the scene's diagonal, so that the same
// numbers come out whatever the model's units; scale and shift then fit the image of all points,
// not of their box, into the viewport.
#include "render/camera.h"

#include <algorithm>

namespace hexwright {
namespace {

// In diagonals of the scene: near enough for a sense of depth, far enough to keep parallels nearly
// parallel.
constexpr double kEyeDistance = 3.5;

}  // namespace

Camera::Camera(std::span<const Vec3> points, const Vec3& direction, const Viewport& viewport) {
  Box3 box;
  for (const Vec3& p : points) box.extend(p);
  if (!box.is_empty() && box.diagonal() > 0) unit_ = box.diagonal();
  forward_ = normalized(direction);
  const Vec3 z = {0, 0, 1};
  // Right and up from the view direction and z; undefined when these are parallel.
  right_ = normalized(cross(forward_, z));
  if (norm(cross(forward_, z)) < 1e-6) right_ = {1, 0, 0};  // from above or below: y is up
  up_ = cross(right_, forward_);
  const Vec3 center = box.is_empty() ? Vec3{} : box.center();
  eye_ = center - kEyeDistance * unit_ * forward_;

  Box3 frame;
  for (const Vec3& p : points) {
    const ScreenPoint s = project_unscaled(p);
    frame.extend(Vec3{s.x, s.y, 0});
  }
  if (frame.is_empty()) frame.extend(Vec3{});
  // A scene seen edge-on has no extent in one direction; the least one keeps the division safe.
  const Vec3 extent = max(frame.extent(), Vec3{1e-9, 1e-9, 0});
  scale_ = std::min(viewport.width / extent.x, viewport.height / extent.y);
  shift_x_ = viewport.left + viewport.width / 2 - scale_ * frame.center().x;
  shift_y_ = viewport.top + viewport.height / 2 - scale_ * frame.center().y;
}

// The eye stands 3.5 diagonals from the centre, so the distance along the view is at least 3 and
// the division safe for every point of the scene.
ScreenPoint Camera::project_unscaled(const Vec3& p) const {
  const Vec3 v = (p - eye_) / unit_;
  const double nearness = 1 / dot(v, forward_);
  return {dot(v, right_) * nearness, -dot(v, up_) * nearness, nearness};
}

ScreenPoint Camera::project(const Vec3& p) const {
  ScreenPoint s = project_unscaled(p);
  s.x = s.x * scale_ + shift_x_;
  s.y = s.y * scale_ + shift_y_;
  return s;
}

}  // namespace hexwright
