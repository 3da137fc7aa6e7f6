// The last step of meshing a surface whose exact shape is known.
#pragma once

#include "pipeline/loop/round.h"

namespace hexwright {

/// Puts the boundary vertices of the mesh onto the exact shape: those of corners and curves onto
/// the curves' ends and the curves, others onto the surface. Each goes the whole way, or half of it
/// and less, as far as no hex around falls below a scaled Jacobian of 0.4 (or the mesh's
/// least, between that and 0.5), none below that becomes worse, and none loses the proof of a
/// positive Jacobian. Mid-nodes of a mesh of second order follow. Judges the mesh again. Requires
/// options.exact. The report's lengths are shares of the diagonal.
ExactReport put_on_exact_shape(const RoundInput& input, Round& round);

}  // namespace hexwright
