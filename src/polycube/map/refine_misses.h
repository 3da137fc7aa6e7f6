// Refinement where a finished mesh missed the object's surface.
#pragma once

#include <span>
#include <vector>

#include "hexwright/grid/grid.h"

#include "polycube/lattice/lattice.h"
#include "polycube/tets/tet_locator.h"

namespace hexwright::polycube {

/// One flag per cell less deep than `max_level`: some of the points (on or near the object's
/// surface) maps into it. `in_object` locates points in the object's tets.
std::vector<char> mark_cells_of_object_points(const Grid& grid, std::span<const Vec3> points,
                                              const TetLocator& in_object, const Lattice& lattice,
                                              int max_level);

/// The polycube's vertices, each moved a little into the polycube, so that those on its boundary
/// lie in a cell whichever way the boundary looks.
IdVector<VertId, Vec3> inward_places(const TetMesh& polycube);

}  // namespace hexwright::polycube
