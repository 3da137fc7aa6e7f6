// Refines the polycube's lattice where the map stretches.
#pragma once

#include "hexwright/polycube/polycube.h"

#include "polycube/lattice/lattice.h"
#include "polycube/map/boundary_map.h"
#include "polycube/tets/tet_locator.h"

namespace hexwright::polycube {

/// What sampling needs of a map; views that must outlive it.
struct SampledMap {
  const TetMesh& object;
  const Lattice& lattice;
  const TetLocator& locator;  ///< in the polycube
  const BoundaryMap& boundary;
};

/// Splits root cubes, level by level, while in a cell
/// - two of the object's vertices are farther apart than max_stretch times the object's diagonal
///   (paper, section 6.2), or the cell is longer than that along an axis, mapped,
/// - or its mapped edges are longer than the size field asks for,
/// - or its faces on the boundary, mapped, stray from the object's surface by more than
///   max_surface_error.
/// Errors: OutOfResources past max_cells.
Grid sample_map(const SampledMap& map, const PolycubeOptions& options, const Context& context);

}  // namespace hexwright::polycube
