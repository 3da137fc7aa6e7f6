// The last step of meshing a surface whose exact shape is known.
#pragma once

#include "pipeline/loop/round.h"

namespace hexwright {

/// Puts the boundary vertices of the mesh onto the exact shape: those of corners and curves onto
/// the curves' ends and the curves, others onto the surface. Each goes the whole way, or half of it
/// and less, as far as no hex around with a scaled Jacobian below 0.4, or below the
/// mesh's least, becomes worse or falls below it, and none loses the proof of a positive Jacobian.
/// Judges the mesh again. Requires options.exact. The report's lengths are shares of the diagonal.
ExactReport put_on_exact_shape(const RoundInput& input, Round& round);

}  // namespace hexwright
