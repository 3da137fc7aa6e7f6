#include "hexwright/base/parallel.h"

#include "fit/finish.h"
#include "fit/proof.h"
#include "fit/targets.h"

namespace hexwright::fitting {
namespace {

void snap_vertex(FitState& state, VertId v, double least_quality) {
  const IdSpan<VertId, const Vec3> positions(state.mesh.positions);
  const Vec3 origin = state.mesh.positions[v];
  const double before = min_scaled_jacobian_around(origin, state.stars[v], positions);
  int unproven = -1;  // not counted yet
  double share = 1;
  for (int attempt = 0; attempt < 5; ++attempt, share *= 0.5) {
    const Vec3 there = origin + share * (state.target[v] - origin);
    const double after = min_scaled_jacobian_around(there, state.stars[v], positions);
    if (!(after > 0 && after >= std::min(before - 1e-9, least_quality))) continue;
    if (after < kProvenQuality && unproven < 0) unproven = count_unproven_around(state, v);
    state.mesh.positions[v] = there;
    if (after >= kProvenQuality || count_unproven_around(state, v) <= unproven) return;
    state.mesh.positions[v] = origin;
  }
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

}  // namespace hexwright::fitting
