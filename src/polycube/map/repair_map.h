// Makes the tets of a map positive again where its deformation left some flat or inverted.
#pragma once

#include "hexwright/base/context.h"

#include "polycube/lattice/lattice.h"

namespace hexwright::polycube {

struct RepairReport {
  std::size_t num_split_edges = 0;  ///< edges through the inside between two vertices of one face
  std::size_t num_nonpositive = 0;  ///< tets of the polycube that remain so
  IdVector<TetId, TetId> to_input;  ///< tet -> the tet of the input it is a part of
};

/// Moves the polycube's vertices around non-positive tets, those on the boundary within their
/// faces, edges and corners; in widening surroundings until all tets are positive, at last
/// everywhere. Interior edges whose ends lie on one face of the polycube are split there in both
/// meshes first: tets beyond them would stay flat. Boundary facets, the object's shape and the map
/// elsewhere stay as they were; when nothing is gained everything does.
RepairReport repair_map(TetMesh& object, Lattice& lattice, const Context& context);

}  // namespace hexwright::polycube
