// The boundary of a tetrahedral mesh as a triangle surface over the same vertices.
#pragma once

#include "hexwright/mesh/tet_mesh.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright::polycube {

/// Facets that belong to one tet only, outward by the tets' orientation, in order of (tet, local
/// face). Vertex ids are those of the tet mesh.
IdVector<TriId, std::array<VertId, 3>> boundary_facets(const TetMesh& mesh);

}  // namespace hexwright::polycube
