// Weights (mean_weights.h) and positions take turns; the inner energy is VertexNewton's with blend
// 1 and power p.
#include "hexwright/base/context.h"

#include "relax/passes/finish.h"
#include "relax/passes/mean_weights.h"
#include "relax/passes/slide_only.h"
#include "relax/passes/sweep.h"
#include "relax/state/targets.h"

namespace hexwright::relax {

void sweep_for_average(FitState& state, double least, const AverageOptions& options,
                       const Context& context) {
  for (int s = 0; s < options.sweeps; ++s) {
    context.check_cancelled();
    const auto weight = mean_weights(state.mesh, options.power);
    SweepOptions sweep_options{{1, options.power, 0}, 0, options.tolerance};
    sweep_options.quality_floor = least;
    sweep_options.edge_floor = kEdgeFloor;
    sweep_options.relaxation = options.relaxation;
    sweep_options.hex_weight = &weight;
    sweep(state, sweep_options);
  }
}

void raise_average(FitState& state, const FitTarget& target, const AverageOptions& options,
                   const Context& context) {
  update_targets(state, target, 0);
  state.mark_all_dirty();
  {
    // Curves keep their vertices: where these gather, chords elsewhere leave the curve.
    const SlideOnly slide(state, std::vector<char>(state.num_verts(), 1), true);
    sweep_for_average(state, options.floor, options, context);
  }
  snap_to_targets(state, target, options.floor);
}

}  // namespace hexwright::relax
