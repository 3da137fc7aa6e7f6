// The orthogonal frame that most of a part's faces follow, so that the lattice lies along them.
//
// Hexes stand along the lattice's axes: a plane face across them becomes a staircase that the fit
// has to press flat, which costs hexes, quality and creases (docs/algorithms/placement.md).
#pragma once

#include "hexwright/geometry/rotation.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

/// The rotation into the dominant orthogonal frame of the faces' normals. The identity unless that
/// frame has at least 25% of the area along its axes and 10% more than the given one. Axes keep the
/// order and the signs nearest to the given ones. Linear; the same for any order of triangles up to
/// rounding.
Rotation find_pose(const TriMesh& surface);

/// A copy of the surface, turned. Vertices of faces that lie in one plane across an axis, to within
/// `tolerance` (a length), get exactly one coordinate there: rounding would leave a face that is
/// nearly, but not quite, on a lattice plane. The identity changes nothing.
TriMesh turn_surface(const TriMesh& surface, const Rotation& pose, double tolerance);

/// The turn by multiples of 90 degrees into an attitude that depends on the shape alone: the
/// longest extent along z, the shortest along y, and signs by the third moments of the area, then
/// by the edges and vertices of the triangulation. A part and its copy turned by 90 degrees come to
/// lie alike, every bit the same. Linear; the same for
/// any order of triangles.
Rotation find_canonical_turn(const TriMesh& surface);

}  // namespace hexwright
