// What an object fills, as grids ask for it: even_levels asks an Occupancy, not a surface, so that
// it serves grids of objects that have none.
#pragma once

#include <functional>

#include "hexwright/base/vec3.h"

namespace hexwright {

class SurfaceTree;

/// Two questions about space; both are asked from many threads at once.
struct Occupancy {
  /// Whether the object's surface comes into or near a box; true where that is not clear.
  std::function<bool(const Box3&)> meets_surface;
  /// Of points off the surface.
  std::function<bool(const Vec3&)> is_inside;
  /// Points joined by a way that does not meet the surface lie on one side, so that one of them
  /// need be asked for. False for surfaces with holes.
  bool has_two_sides = true;
};

/// The inside of a surface by its winding number. Keeps a reference to the tree.
Occupancy occupancy_of(const SurfaceTree& tree);

}  // namespace hexwright
