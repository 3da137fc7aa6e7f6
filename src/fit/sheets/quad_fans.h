// How a set of boundary quads and the others lie around a vertex.
#pragma once

#include <vector>

#include "hexwright/base/function_ref.h"

#include "fit/curves/boundary_state.h"

namespace hexwright::fitting {

using relax::BoundaryEdgeId;

struct QuadFans {
  int num_inside = 0;   ///< edge-connected fans of the set's quads at the vertex
  int num_outside = 0;  ///< and of the others
  std::vector<BoundaryEdgeId> marked_outside;  ///< marked edges between two of the others
};

QuadFans find_quad_fans(const BoundaryState& boundary, VertId v,
                        FunctionRef<bool(QuadId)> is_inside);

}  // namespace hexwright::fitting
