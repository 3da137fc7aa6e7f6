// Names for the faces of the domain around an object.
#pragma once

#include "hexwright/grid/grid.h"
#include "hexwright/mesh/hex_mesh.h"

namespace hexwright {

/// The box that the roots of a domain fill, when they fill one.
Box3 box_of(const GridDomain& domain);

/// Boundary quads in the planes of the box that have no label yet become patches of their own:
/// xmin, xmax, ymin, ymax, zmin, zmax. Mesh and box in the same coordinates.
void name_outer_faces(const Box3& box, HexMesh& mesh);

}  // namespace hexwright
