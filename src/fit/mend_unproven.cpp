// Positive corners do not make a hex positive inside; better corners nearly always do.
#include "hexwright/base/context.h"
#include "hexwright/base/parallel.h"
#include "hexwright/quality/hex_quality.h"

#include "fit/finish.h"
#include "fit/sweep.h"
#include "fit/targets.h"

namespace hexwright::fitting {
namespace {

std::vector<HexId> find_unproven(const HexMesh& mesh) {
  std::vector<char> is_proven(mesh.num_hexes());
  parallel_for(
      mesh.num_hexes(),
      [&](std::size_t h) {
        is_proven[h] = check_positivity(mesh.corners(HexId(h))) == Positivity::Positive;
      },
      256);
  std::vector<HexId> unproven;
  for (std::size_t h = 0; h < is_proven.size(); ++h)
    if (!is_proven[h]) unproven.push_back(HexId(h));
  return unproven;
}

}  // namespace

std::vector<HexId> mend_unproven(FitState& state, const FitTarget& target, const Context& context) {
  auto unproven = find_unproven(state.mesh);
  for (double weight : {1e4, 1e2, 1.0, 0.0}) {
    if (unproven.empty()) break;
    context.check_cancelled();
    std::vector<char> region(state.num_verts(), 0);
    for (HexId h : unproven)
      for (VertId v : state.mesh.hexes[h]) region[v.index()] = 1;
    grow_vert_set(state, region, 1);
    update_targets(state, target, 0, region);
    const LocalSweep local(state, region);
    SweepOptions options{{0.9, 3, 0}, weight, 0.03};
    options.quality_floor = 0.2;  // no hex is made poor for another one's proof
    for (int s = 0; s < 4; ++s) local.run(state, options);
    unproven = find_unproven(state.mesh);
  }
  return unproven;
}

}  // namespace hexwright::fitting
