// Positive corners do not make a hex positive inside; better corners nearly always do.
#include <algorithm>
#include <optional>
#include <utility>

#include "hexwright/base/context.h"
#include "hexwright/quality/hex_quality.h"

#include "relax/passes/finish.h"
#include "relax/passes/slide_only.h"
#include "relax/passes/sweep.h"
#include "relax/state/proof.h"
#include "relax/state/targets.h"

namespace hexwright::relax {
namespace {

constexpr double kMaxResidual = 0.05;  // in h: a proof is not worth more distance
// Of quality, besides what there was: a poor hex is better than one that is not valid.
constexpr double kPoorFloors[] = {0.2, 0.1};

double worst_residual(const FitState& state, const std::vector<char>& region) {
  double worst = 0;
  for (VertId v : state.kind.ids())
    if (region[v.index()]) worst = std::max(worst, state.residual(v));
  return worst;
}

// First only sliding, then a little off the surface.
struct Attempt {
  bool slides;
  int power;
  double weight;
};
constexpr Attempt kAttempts[] = {{true, 3, 0}, {true, 8, 0}, {false, 3, 1e4}, {false, 3, 1e3}};

std::vector<char> surroundings(const FitState& state, const std::vector<HexId>& hexes) {
  std::vector<char> region(state.num_verts(), 0);
  for (HexId h : hexes)
    for (VertId v : state.mesh.hexes[h]) region[v.index()] = 1;
  grow_vert_set(state, region, 1);
  return region;
}

// Undone when it costs distance. No hex is made poorer than `floor` for another one's proof.
void try_attempt(FitState& state, const FitTarget& target, const std::vector<char>& region,
                 const Attempt& attempt, double floor) {
  update_targets(state, target, 0, region);
  const double allowed = std::max(kMaxResidual, worst_residual(state, region));
  const auto positions = state.mesh.positions;
  const auto arcs = state.arc;
  SweepOptions options{{0.9, attempt.power, 0}, attempt.weight, 0.03};
  options.quality_floor = floor;
  {
    std::optional<SlideOnly> slide;
    if (attempt.slides) slide.emplace(state, region);
    const LocalSweep local(state, region);
    for (int s = 0; s < 4; ++s) local.run(state, options);
  }
  snap_to_targets(state, target, floor, region);
  if (worst_residual(state, region) <= allowed) return;
  state.mesh.positions = positions;
  state.arc = arcs;
}

}  // namespace

std::vector<HexId> mend_unproven(FitState& state, const FitTarget& target, double slack,
                                 const Context& context) {
  auto unproven = find_unproven(state.mesh);
  if (unproven.empty()) return unproven;
  const auto quality = compute_scaled_jacobians(state.mesh);
  const double floor = std::max(0.2, *std::min_element(quality.begin(), quality.end()));
  for (const Attempt& attempt : kAttempts) {
    context.check_cancelled();
    try_attempt(state, target, surroundings(state, unproven), attempt, floor);
    unproven = find_unproven(state.mesh);
    if (unproven.empty()) return unproven;
  }
  update_targets(state, target, 0);
  std::vector<double> floors = {floor};
  for (double poor : kPoorFloors)
    if (poor < floors.back()) floors.push_back(poor);
  return free_unproven(state, std::move(unproven), slack, floors);
}

}  // namespace hexwright::relax
