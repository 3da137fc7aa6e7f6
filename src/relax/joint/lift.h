// Raises the least scaled Jacobian of a fitted mesh by solving small regions around the poorest
// hexes for all their vertices at once, with boundary vertices allowed off the surface within the
// tolerance, only there and only as far as needed. See docs/algorithms/fit.md.
#pragma once

#include "hexwright/base/context.h"

#include "relax/state/fit_state.h"

namespace hexwright::relax {

struct JointLiftOptions {
  /// Two-way distance that the mesh may have, a length. Boundary vertices stay within 0.6 of it,
  /// the middles of quads within 0.8; curves and corners by their own, fixed shares of the
  /// diagonal.
  double tolerance = 0;
  double goal = 0.5;     ///< least scaled Jacobian to be content with
  bool is_last = false;  ///< only the two most generous stages, after other passes smoothed
};

/// Raises the least of every region it changes; no hex loses the proof that its Jacobian is
/// positive inside. Leaves current targets. The same for any number of threads.
void lift_jointly(FitState& state, const FitTarget& target, const JointLiftOptions& options,
                  const Context& context);

}  // namespace hexwright::relax
