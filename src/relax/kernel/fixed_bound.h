// How good a mesh's worst element can get at best when some vertices are held.
#pragma once

#include "hexwright/mesh/hex_adjacency.h"

namespace hexwright::relax {

struct QualityBound {
  double value = 1;  ///< no placement of the free vertices gives a larger least scaled Jacobian
  HexId hex;         ///< a hex that says so; invalid when the bound is 1
};

/// Looks at the corners at held vertices with two held neighbours. The hexes that share the third,
/// free edge (v, w) of such corners have scaled Jacobians n_i . d there, where d is the direction
/// of the edge and n_i the cross product of the unit held edges: the least of them is at most the
/// distance of the n_i's convex hull from the origin. Corners held entirely count as they are.
QualityBound bound_quality(const HexMesh& mesh, const VertToHex& vert_to_hex,
                           const IdVector<VertId, char>& is_held);

}  // namespace hexwright::relax
