// Refines the polycube's lattice where the map stretches.
#pragma once

#include "hexwright/polycube/polycube.h"

#include "polycube/lattice.h"
#include "polycube/tet_locator.h"

namespace hexwright::polycube {

/// Splits root cubes, level by level, while two points of the object that map into a cell lie
/// farther apart than max_stretch times the object's diagonal (paper, section 6.2). Measured on the
/// images of 27 points of the cell and on the object's vertices that map into it. Errors:
/// OutOfResources past max_cells.
Grid sample_map(const TetMesh& object, const Lattice& lattice, const TetLocator& locator,
                const PolycubeOptions& options, const Context& context);

}  // namespace hexwright::polycube
