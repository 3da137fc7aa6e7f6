// Parts of a surface between sharp edges, from a point on them.
#pragma once

#include <vector>

#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

/// Per triangle: whether it is reached from the one nearest to `seed`, the lowest of equally near
/// ones, across edges whose two sides turn by at most the angle of this cosine. Vertices in one
/// place are one; edges of three and more triangles are not crossed; triangles may be oriented
/// either way.
std::vector<char> flood_by_angle(const TriMesh& mesh, const Vec3& seed, double least_cosine);

}  // namespace hexwright
