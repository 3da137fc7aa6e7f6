// The last passes of the fit: they work where something is left to do.
#pragma once

#include <span>
#include <vector>

#include "relax/state/fit_state.h"

namespace hexwright::relax {

/// Moves boundary vertices onto their targets, halving the way up to five times, while the least
/// scaled Jacobian around stays above min(its present value, `least_quality`) and above 0.
/// `only`: empty or one entry per vertex.
void snap_to_targets(FitState& state, const FitTarget& target, double least_quality,
                     std::span<const char> only = {});

/// Moves corners that are farther than `tolerance` (a length) from their feature point just within
/// it, where the least scaled Jacobian around stays above min(its present value, `least_quality`)
/// and above 0. Requires current targets. Returns how many it moved.
std::size_t meet_corners(FitState& state, double tolerance, double least_quality);

struct LiftOptions {
  double goal = 0.65;  ///< least scaled Jacobian to be content with
  int max_rounds = 20;
  double residual_slack = 1e-4;  ///< how much the sum of squared residuals (in h) may grow
};
/// Raises the least scaled Jacobian with boundary vertices sliding only. Never lowers it.
void lift_worst(FitState& state, const FitTarget& target, const LiftOptions& options,
                const Context& context);

struct AverageOptions {
  int sweeps = 3;
  int power = 8;  ///< a power of 2; the larger, the more a hex is judged by its worst corner alone
  double tolerance = 0.01;
  double relaxation = 1.6;  ///< see SweepOptions; what three sweeps reach took nine at 1
  double floor = 0;         ///< nowhere the least falls below both this and what it was
};
/// Raises the average scaled Jacobian of dirty vertices' surroundings within the motion their
/// `move` allows; no move takes the least around a vertex below both `least` and what it was.
void sweep_for_average(FitState& state, double least, const AverageOptions& options,
                       const Context& context);
/// Raises the average scaled Jacobian of the whole mesh with boundary vertices sliding only, then
/// snaps them.
void raise_average(FitState& state, const FitTarget& target, const AverageOptions& options,
                   const Context& context);

/// Works on hexes whose Jacobian is not proven positive everywhere inside, letting go of the
/// surface around them more and more, by `slack` (a length) in the end; returns those that remain.
std::vector<HexId> mend_unproven(FitState& state, const FitTarget& target, double slack,
                                 const Context& context);

/// The last of it: moves vertices of these hexes one at a time to where the hexes around them are
/// positive inside, boundary vertices by at most `slack` (and their size) off where they belong. No
/// scaled Jacobian falls below min(what was the least there, the floor); the floors count in turn,
/// for what the ones before left. Requires current targets. Returns all unproven hexes that remain.
std::vector<HexId> free_unproven(FitState& state, std::vector<HexId> unproven, double slack,
                                 std::span<const double> floors);

}  // namespace hexwright::relax
