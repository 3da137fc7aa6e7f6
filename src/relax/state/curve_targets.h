// Where curve and corner vertices are pulled to.
#pragma once

#include "relax/state/fit_state.h"

namespace hexwright::relax {

/// Sets target and direction of a Curve or Corner vertex and marks it dirty.
/// `hold` in [0, 1]: 1 holds a curve vertex at its parameter, less lets it glide along the tangent
/// with that share of the stiffness, 0 lets it move: the target is then the closest point within
/// 1.5 sizes of its parameter, which follows.
void update_feature_target(FitState& state, VertId v, const TriMesh& surface,
                           const FeatureGraph& features, double hold);

}  // namespace hexwright::relax
