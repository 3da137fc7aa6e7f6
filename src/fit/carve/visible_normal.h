// A direction that sees all faces around a vertex.
//
// Based on: Gilbert, "An iterative procedure for computing the minimum of a quadratic form on a
// convex set", SIAM J. Control 4(1), 1966: the point of the normals' convex hull nearest to the
// origin is the direction with the largest least cosine.
#pragma once

#include <span>

#include "hexwright/base/vec3.h"

namespace hexwright::fitting {

struct VisibleDirection {
  Vec3 direction;     ///< unit
  double cosine = 1;  ///< least dot product of the direction with a normal
};

/// Looks for the unit vector d that maximises the least n . d over the unit vectors `normals` (at
/// least one). Stops early once the least cosine reaches `enough`.
VisibleDirection find_visible_direction(std::span<const Vec3> normals, double enough = 0.95);

}  // namespace hexwright::fitting
