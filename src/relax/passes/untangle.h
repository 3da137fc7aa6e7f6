// Brings inverted hexes back to positive corner determinants, where vertices that may move can.
#pragma once

#include "hexwright/base/context.h"

#include "relax/state/fit_state.h"

namespace hexwright::relax {

/// Works on growing surroundings of the inverted hexes with a regularised energy. Returns how many
/// hexes have a corner determinant that is not positive in the end.
std::size_t untangle(FitState& state, const Context& context);

}  // namespace hexwright::relax
