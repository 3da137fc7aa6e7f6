// Vertices of a hex mesh's boundary that lie inside an edge or a face of a hex they do not belong
// to, as in grids whose levels were never made conforming.
#pragma once

#include <vector>

#include "quality/topology/boundary_surface.h"

namespace hexwright {

struct HangingVert {
  VertId vert;
  HexFace face;  ///< a boundary face that holds the vertex inside an edge or inside itself
};

/// Sorted by vertex, and those of a vertex by the boundary's order. A vertex counts when it is
/// within 1e-5 of the face's size of an edge's inside, or of the face's four triangles about its
/// centre.
std::vector<HangingVert> find_hanging_verts(const HexMesh& mesh, const BoundarySurface& boundary);

}  // namespace hexwright
