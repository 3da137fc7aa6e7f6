// The worst elements after everything has arrived: boundary vertices slide in the tangent plane of
// the surface or along the tangent of their curve, so that quality is not bought with distance.
#include <algorithm>

#include "hexwright/base/context.h"
#include "hexwright/quality/hex_quality.h"

#include "fit/finish.h"
#include "fit/slide_only.h"
#include "fit/sweep.h"
#include "fit/targets.h"

namespace hexwright::fitting {
namespace {

struct Score {
  double least = 0;           // scaled Jacobian
  double residual = 0;        // sum of squares, in h
  double worst_residual = 0;  // in h

  // More quality, and not paid for with distance.
  bool beats(const Score& other, double slack) const {
    return least > other.least + 1e-4 && residual <= other.residual + slack &&
           worst_residual <= other.worst_residual + 0.01;
  }
};

Score score(const FitState& state, const IdVector<HexId, double>& quality) {
  Score s;
  s.least = *std::min_element(quality.begin(), quality.end());
  for (VertId v : state.kind.ids()) {
    const double r = state.stars[v].empty() ? 0 : state.residual(v);
    s.residual += r * r;
    s.worst_residual = std::max(s.worst_residual, r);
  }
  return s;
}

std::vector<char> surroundings(const FitState& state, const IdVector<HexId, double>& quality,
                               double low) {
  std::vector<char> region(state.num_verts(), 0);
  for (HexId h : quality.ids())
    if (quality[h] <= low)
      for (VertId v : state.mesh.hexes[h]) region[v.index()] = 1;
  grow_vert_set(state, region, 1);
  return region;
}

}  // namespace

void lift_worst(FitState& state, const FitTarget& target, const LiftOptions& options,
                const Context& context) {
  update_targets(state, target, 0);
  auto quality = compute_scaled_jacobians(state.mesh);
  Score best = score(state, quality);
  auto best_positions = state.mesh.positions;
  auto best_arcs = state.arc;  // targets on curves are looked for near these
  int power = 3;
  for (int round = 0; round < options.max_rounds && best.least < options.goal; ++round) {
    context.check_cancelled();
    const double least = *std::min_element(quality.begin(), quality.end());
    const auto region =
        surroundings(state, quality, std::min(options.goal, least + 0.1 * (1 - least)));
    update_targets(state, target, 0, region);
    {
      const SlideOnly slide(state, region);
      const LocalSweep local(state, region);
      for (int s = 0; s < 4; ++s) local.run(state, {{1, power, 0}, 0, 0.03});
    }
    snap_to_targets(state, target, least, region);
    quality = compute_scaled_jacobians(state.mesh);
    const Score now = score(state, quality);
    if (now.beats(best, options.residual_slack)) {
      const bool is_progress = now.least > best.least + 1e-3;
      best = now;
      best_positions = state.mesh.positions;
      best_arcs = state.arc;
      if (is_progress) continue;
    }
    if (power >= 48) break;
    power *= 2;
  }
  state.mesh.positions = best_positions;
  state.arc = best_arcs;
  update_targets(state, target, 0);
}

}  // namespace hexwright::fitting
