#include "hexwright/base/context.h"
#include "hexwright/quality/hex_quality.h"

#include "relax/passes/finish.h"
#include "relax/passes/sweep.h"
#include "relax/state/targets.h"

namespace hexwright::relax {

void polish_worst(FitState& state, const FitTarget& target, const PolishOptions& options,
                  const Context& context) {
  for (int round = 0; round < options.max_rounds; ++round) {
    context.check_cancelled();
    const auto quality = compute_scaled_jacobians(state.mesh);
    std::vector<char> region(state.num_verts(), 0);
    bool any = false;
    for (HexId h : quality.ids()) {
      if (quality[h] >= options.low) continue;
      any = true;
      for (VertId v : state.mesh.hexes[h]) region[v.index()] = 1;
    }
    if (!any) return;
    grow_vert_set(state, region, 1);
    if (round > 0) update_targets(state, target, 0, region);
    const LocalSweep local(state, region);
    for (int s = 0; s < 3; ++s) local.run(state, {{0.9, 3, 0}, 1e6, 0.03});
  }
}

}  // namespace hexwright::relax
