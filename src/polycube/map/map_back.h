// Carries a hex mesh of the polycube over to the object.
#pragma once

#include "hexwright/mesh/hex_mesh.h"

#include "polycube/lattice/lattice.h"
#include "polycube/tets/tet_locator.h"

namespace hexwright::polycube {

/// What the polycube's faces, edges and corners are on the object's boundary, over the object's
/// vertices.
struct ObjectFeatures {
  TriMesh surface;  ///< the object's boundary; facet ids as in Lattice::facets
  std::vector<std::array<VertId, 2>> chart_edges;  ///< between two charts
};
ObjectFeatures object_features(const TetMesh& object, const Lattice& lattice);

/// Which part of the object's boundary a mesh vertex stands for: the one with a valid id, or none
/// (inside).
struct BoundaryPlace {
  TriId facet;                   ///< inside a face of the polycube
  std::array<VertId, 2> crease;  ///< on the edge of the polycube that holds this edge of the object
  VertId corner;                 ///< a corner of the polycube, as a vertex of the object
};

struct MappedMesh {
  HexMesh mesh;
  IdVector<VertId, BoundaryPlace> place;
  std::size_t num_bridged = 0;
};

/// Interior vertices by barycentric coordinates in the tet mesh; boundary vertices in the
/// boundary's facets, polycube edges and corners, so that they lie exactly on the object's surface,
/// curves and corners. `hexes` is in lattice units and flush with the domain's boundary.
MappedMesh map_back(const HexMesh& hexes, const TetMesh& object, const Lattice& lattice,
                    const TetLocator& locator);

}  // namespace hexwright::polycube
