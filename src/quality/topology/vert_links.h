// Vertices whose neighbourhood in the hex mesh is not that of a solid.
#pragma once

#include <vector>

#include "quality/topology/boundary_surface.h"

namespace hexwright {

/// Vertices whose link (one triangle per hex at the vertex, one vertex per edge) is not a sphere
/// inside, not a disc on the boundary; sorted. Requires hexes with 8 distinct vertices and faces
/// shared by at most two.
std::vector<VertId> find_singular_verts(const HexMesh& mesh, const BoundarySurface& boundary);

}  // namespace hexwright
