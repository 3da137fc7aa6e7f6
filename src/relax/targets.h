// Where boundary vertices are pulled to.
#pragma once

#include <span>

#include "relax/fit_state.h"

namespace hexwright::relax {

/// Sets target and direction of the boundary vertices (of those with only[v] != 0 when `only` is
/// not empty) from their present positions, and marks a vertex dirty when its target moved.
/// `hold` in [0, 1] holds curve vertices at their parameter (see update_feature_target).
void update_targets(FitState& state, const FitTarget& target, double hold,
                    std::span<const char> only = {});

}  // namespace hexwright::relax
