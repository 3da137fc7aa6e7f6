// Vertices on the surface leave every quad over a curved patch on one side of it. Moved along the
// normal by a share of the sag, the same quads lie half on either side, at a fraction of the
// distance.
#pragma once

#include "relax/state/fit_state.h"

namespace hexwright::relax {

struct BalanceOptions {
  double max_offset = 0.1;  ///< in h
  int num_sweeps = 5;       ///< of the least-squares solver
};

/// Sets `state.offset` of the Surface vertices so that the boundary quads fit the surface best in
/// the mean square, curves and corners being where they are. Moves nothing: the next targets do.
/// Requires up-to-date targets.
void balance_offsets(FitState& state, const FitTarget& target, const BalanceOptions& options = {});

}  // namespace hexwright::relax
