// Moves boundary vertices onto their targets, one at a time, where quality allows.
#include <algorithm>

#include "hexwright/base/parallel.h"

#include "relax/passes/finish.h"
#include "relax/state/proof.h"
#include "relax/state/targets.h"

namespace hexwright::relax {
namespace {

/// Goes a share of the way to the target; stays, and returns false, where that costs too much.
bool try_move(FitState& state, VertId v, double share, double least_quality) {
  const IdSpan<VertId, const Vec3> positions(state.mesh.positions);
  const Vec3 origin = state.mesh.positions[v];
  const Vec3 there = origin + share * (state.target[v] - origin);
  const double before = min_scaled_jacobian_around(origin, state.stars[v], positions);
  const double after = min_scaled_jacobian_around(there, state.stars[v], positions);
  if (!(after > 0 && after >= std::min(before - 1e-9, least_quality))) return false;
  if (after >= kProvenQuality) {
    state.mesh.positions[v] = there;
    return true;
  }
  const int unproven = count_unproven_around(state, v);
  state.mesh.positions[v] = there;
  if (count_unproven_around(state, v) <= unproven) return true;
  state.mesh.positions[v] = origin;
  return false;
}

void snap_vertex(FitState& state, VertId v, double least_quality) {
  double share = 1;
  for (int attempt = 0; attempt < 5; ++attempt, share *= 0.5)
    if (try_move(state, v, share, least_quality)) return;
}

}  // namespace

void snap_to_targets(FitState& state, const FitTarget& target, double least_quality,
                     std::span<const char> only) {
  update_targets(state, target, 0, only);
  for (std::size_t c = 0; c < state.colors.num_colors(); ++c) {
    const auto verts = state.colors[c];
    parallel_for(
        verts.size(),
        [&](std::size_t i) {
          if (!only.empty() && !only[verts[i].index()]) return;
          if (state.is_boundary(verts[i]) && state.move[verts[i]] != MoveIn::Point)
            snap_vertex(state, verts[i], least_quality);
        },
        64);
  }
}

std::size_t meet_corners(FitState& state, double tolerance, double least_quality) {
  std::size_t num_moved = 0;
  for (VertId v : state.kind.ids()) {
    if (state.kind[v] != VertKind::Corner || state.stars[v].empty()) continue;
    if (state.move[v] == MoveIn::Point) continue;
    const double miss = distance(state.mesh.positions[v], state.target[v]);
    if (miss > tolerance) num_moved += try_move(state, v, 1 - tolerance / miss, least_quality);
  }
  return num_moved;
}

}  // namespace hexwright::relax
