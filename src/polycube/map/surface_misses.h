// Where the domain's boundary, carried to the object cell by cell, strays from the object's
// surface.
#pragma once

#include <vector>

#include "hexwright/grid/grid.h"

#include "polycube/map/boundary_map.h"

namespace hexwright::polycube {

/// One flag per cell: some point of the object's surface that maps into the cell, or to one of its
/// faces on the domain's boundary, is farther than `limit` (in the object's units) from the quads
/// between the mapped corners of all boundary faces. `inward` are the polycube's vertices, each
/// moved a little into the polycube.
std::vector<char> mark_surface_misses(const Grid& grid, const TetMesh& object,
                                      const Lattice& lattice, const BoundaryMap& boundary,
                                      const IdVector<VertId, Vec3>& inward, double limit);

}  // namespace hexwright::polycube
