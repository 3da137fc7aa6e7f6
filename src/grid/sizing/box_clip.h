// Exact clipping of triangles to a cube, in the cube's own coordinates.
#pragma once

#include <array>

#include "hexwright/base/vec3.h"

namespace hexwright::grids {

/// A convex polygon; clipping a triangle by six planes leaves at most nine vertices.
struct ClippedPolygon {
  std::array<Vec3, 10> points;
  int count = 0;
};

/// The part of a triangle inside the cube [-half, half]^3; count is 0 when they do not meet.
ClippedPolygon clip_to_cube(const std::array<Vec3, 3>& tri, double half);

/// Whether a triangle meets the cube [-half, half]^3.
bool meets_cube(const std::array<Vec3, 3>& tri, double half);

/// Whether a segment meets the cube [-half, half]^3.
bool segment_meets_cube(const Vec3& a, const Vec3& b, double half);

/// Whether a point lies in the cube [-half, half]^3.
inline bool in_cube(const Vec3& p, double half) {
  return std::abs(p.x) <= half && std::abs(p.y) <= half && std::abs(p.z) <= half;
}

}  // namespace hexwright::grids
