// The part of a background mesh that a carve keeps, as the state the fit starts from.
#pragma once

#include "relax/state/fit_state.h"

namespace hexwright::fitting {

using relax::FitState;

/// `is_inside`: per hex of the background. Inside: those hexes. Outside: the others. Both: all,
/// with region tags. Vertices on the background's own boundary may move only in the planes of its
/// faces (along an edge, not at all at a corner) except with Inside, where they are like any
/// others.
FitState keep_side(const HexMesh& background, const std::vector<char>& is_inside, Side side);

}  // namespace hexwright::fitting
