// Small functions of quads.
#pragma once

#include <algorithm>
#include <array>

#include "hexwright/base/vec3.h"
#include "hexwright/mesh/element_ids.h"

namespace hexwright {

/// A quad as a key: its vertices, whatever the one it starts with and the way around.
inline std::array<VertId, 4> sorted(std::array<VertId, 4> quad) {
  std::sort(quad.begin(), quad.end());
  return quad;
}

/// Half the length of the diagonals' cross product: exact for plane quads, for others the area of
/// the projection that is largest. `positions`: indexed by vertex.
template <class Positions>
double quad_area(const Positions& positions, const std::array<VertId, 4>& q) {
  return 0.5 * norm(cross(positions[q[2]] - positions[q[0]], positions[q[3]] - positions[q[1]]));
}

/// Of the four triangles about the centre: near the area of the patch that a warped quad is to
/// solvers, where quad_area tells less.
template <class Positions>
double patch_area(const Positions& positions, const std::array<VertId, 4>& q) {
  Vec3 center;
  for (VertId v : q) center += positions[v] / 4;
  double area = 0;
  for (std::size_t k = 0; k < 4; ++k)
    area += 0.5 * norm(cross(positions[q[k]] - center, positions[q[(k + 1) % 4]] - center));
  return area;
}

/// Of length 1, as the quad goes round: the direction in which its projection is largest.
template <class Positions>
Vec3 quad_normal(const Positions& positions, const std::array<VertId, 4>& q) {
  return normalized(cross(positions[q[2]] - positions[q[0]], positions[q[3]] - positions[q[1]]));
}

}  // namespace hexwright
