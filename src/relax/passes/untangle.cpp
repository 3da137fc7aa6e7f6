// Based on: Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov, "Foldover-free maps in 50 lines
// of code", ACM TOG 40(4), 2021. Differs: one vertex at a time, with a regularisation of its own
// from the determinants around it.
#include "relax/passes/untangle.h"

#include "hexwright/base/parallel.h"
#include "hexwright/quality/hex_quality.h"

#include "relax/passes/finish.h"
#include "relax/passes/sweep.h"

namespace hexwright::relax {
namespace {

std::vector<char> verts_of_inverted(const FitState& state, std::size_t& num_inverted) {
  const auto quality = compute_scaled_jacobians(state.mesh);
  std::vector<char> region(state.num_verts(), 0);
  num_inverted = 0;
  for (HexId h : quality.ids()) {
    if (quality[h] > 0) continue;
    ++num_inverted;
    for (VertId v : state.mesh.hexes[h]) region[v.index()] = 1;
  }
  return region;
}

}  // namespace

std::size_t untangle(FitState& state, const Context& context) {
  std::size_t num_inverted = 0, before = 0;
  auto region = verts_of_inverted(state, num_inverted);
  int rings = 1;
  for (int round = 0; round < 40 && num_inverted > 0; ++round) {
    context.check_cancelled();
    grow_vert_set(state, region, rings);
    SweepOptions options;
    options.untangle_share = round % 2 == 0 ? 0.1 : 0.01;
    const LocalSweep local(state, region);
    for (int s = 0; s < 10; ++s) local.run(state, options);
    before = num_inverted;
    region = verts_of_inverted(state, num_inverted);
    if (num_inverted >= before) rings = std::min(rings + 1, 6);
  }
  return num_inverted;
}

}  // namespace hexwright::relax
