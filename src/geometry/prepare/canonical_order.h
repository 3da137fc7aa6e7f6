// An order of vertices and triangles that follows from the surface alone.
#pragma once

#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

/// Numbers vertices by place (x, then y, then z), begins triangles with their least vertex, and
/// sorts them; `source` goes along. Files that differ in the order of their lines alone come out
/// the same: nothing behind can break a tie by it. Vertices at one place keep their order. Returns
/// the new number of each vertex.
IdVector<VertId, VertId> put_in_canonical_order(TriMesh& mesh, IdVector<TriId, TriId>& source);

/// The same vertices under their new numbers.
IdVector<VertId, Vec3> renumber(const IdVector<VertId, Vec3>& positions,
                                const IdVector<VertId, VertId>& old_to_new);

}  // namespace hexwright
