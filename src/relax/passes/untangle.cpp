// Based on: Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov, "Foldover-free maps in 50 lines
// of code", ACM TOG 40(4), 2021. Differs: one vertex at a time, with a regularisation of its own
// from the determinants around it.
#include "relax/passes/untangle.h"

#include "hexwright/base/parallel.h"
#include "hexwright/quality/hex_quality.h"

#include "relax/passes/finish.h"
#include "relax/passes/sweep.h"
#include "relax/state/targets.h"

namespace hexwright::relax {
namespace {

std::vector<char> verts_of_tangled(const FitState& state, double low, std::size_t& num_tangled) {
  const auto quality = compute_scaled_jacobians(state.mesh);
  num_tangled = 0;
  return verts_of_hexes(state, [&](HexId h) {
    const bool is_tangled = quality[h] <= low;
    num_tangled += is_tangled;
    return is_tangled;
  });
}

}  // namespace

std::size_t untangle(FitState& state, const UntangleOptions& options, const Context& context) {
  std::size_t num_tangled = 0, before = 0;
  auto region = verts_of_tangled(state, options.low, num_tangled);
  int rings = 1;
  for (int round = 0; round < options.max_rounds && num_tangled > 0; ++round) {
    context.check_cancelled();
    grow_vert_set(state, region, rings);
    SweepOptions sweep;
    sweep.untangle_share = options.shares[static_cast<std::size_t>(round) % options.shares.size()];
    sweep.weight = options.weight;
    const LocalSweep local(state, region);
    for (int s = 0; s < options.sweeps; ++s) {
      if (options.target) update_targets(state, *options.target, 0, region);
      local.run(state, sweep);
    }
    before = num_tangled;
    region = verts_of_tangled(state, options.low, num_tangled);
    if (num_tangled >= before) rings = std::min(rings + 1, 6);
  }
  return num_tangled;
}

}  // namespace hexwright::relax
