// Stuck vertices come from several of them having to move together: weakening the attachment around
// them and raising it again slowly lets the neighbours make room.
#include "hexwright/base/context.h"

#include "relax/passes/finish.h"
#include "relax/passes/sweep.h"
#include "relax/state/targets.h"

namespace hexwright::relax {

void grow_vert_set(const FitState& state, std::vector<char>& is_member, int rings) {
  std::vector<VertId> front;
  for (std::size_t v = 0; v < is_member.size(); ++v)
    if (is_member[v]) front.push_back(VertId(v));
  for (int r = 0; r < rings; ++r) {
    std::vector<VertId> next;
    for (VertId v : front) {
      for (const HexCorner& corner : state.vert_to_hex[v]) {
        for (VertId u : state.mesh.hexes[corner.hex]) {
          if (is_member[u.index()]) continue;
          is_member[u.index()] = 1;
          next.push_back(u);
        }
      }
    }
    front = std::move(next);
  }
}

void mark_boundary_dirty(FitState& state, const std::vector<char>& region) {
  for (VertId v : state.kind.ids())
    if (region[v.index()] && state.is_boundary(v)) state.is_dirty[v] = 1;
}

void refit_stuck(FitState& state, const FitTarget& target, const RefitOptions& options,
                 const Context& context) {
  for (int round = 0; round < options.max_rounds; ++round) {
    update_targets(state, target, 0);
    std::vector<char> region(state.num_verts(), 0);
    bool any = false;
    for (VertId v : state.kind.ids()) {
      if (state.stars[v].empty() || !(state.residual(v) > options.stuck)) continue;
      region[v.index()] = 1;
      any = true;
    }
    if (!any) return;
    grow_vert_set(state, region, options.rings);
    const LocalSweep local(state, region);
    for (VertId v : state.kind.ids())
      if (region[v.index()]) state.is_dirty[v] = 1;
    for (double weight : {30.0, 100.0, 300.0, 1e3, 3e3, 1e4, 1e5}) {
      context.check_cancelled();
      update_targets(state, target, 0, region);
      mark_boundary_dirty(state, region);
      for (int s = 0; s < 3; ++s) local.run_dirty(state, {options.shape, weight, 0.01});
    }
  }
}

}  // namespace hexwright::relax
