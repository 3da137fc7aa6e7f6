// Options that follow from others.
#include "hexwright/pipeline/plan.h"

#include <algorithm>
#include <utility>

#include "hexwright/pipeline/size_plan.h"

namespace hexwright {
namespace {

DualMode dual_mode_of(Pairing pairing) {
  return pairing == Pairing::Blocks || pairing == Pairing::Octree ? DualMode::Blocks
                                                                  : DualMode::Sheets;
}

/// Open or overlapping surfaces leave misses that no depth of cells cures, where parts meet: the
/// loop gets this share of its budget ...
constexpr std::size_t kDefectiveShare = 4;
/// ... and a round must not cost more than this factor in cells, for marks that are dense along the
/// seams of parts would multiply the mesh. On a sound surface the next round may well need many
/// times the cells of a coarse mesh that came within the gate by luck.
constexpr double kMaxGrowth = 2.5;

/// Guards of a budget that is larger than they are: the background has cells outside too.
constexpr double kBackgroundOfHexes = 4, kRoundsOfHexes = 1.4;
/// Budgets beyond this are alike: several times as many still fit a std::size_t.
constexpr double kMostOfHexes = 0x1p59;
/// Of eight cells that a size asks for, one or more are meshed; few enough are no matter.
constexpr double kSizedOfHexes = 16;
constexpr std::size_t kFewCells = 32768;

Budgets plan_budgets(const MeshOptions& wishes, const Target& target) {
  const bool is_sound = target.expected.is_known && target.diagnosis.num_boundary_edges == 0;
  const double most = std::min(static_cast<double>(wishes.most_hexes), kMostOfHexes);
  const auto at_least = [&](std::size_t guard, double factor) {
    return std::max(guard, static_cast<std::size_t>(factor * most));
  };
  Budgets budgets{.background = at_least(wishes.max_hexes, kBackgroundOfHexes),
                  .rounds = at_least(wishes.max_loop_hexes, kRoundsOfHexes)};
  budgets.sized = budgets.background;
  if (wishes.most_hexes > 0)
    budgets.sized = std::min(budgets.background, at_least(kFewCells, kSizedOfHexes));
  if (is_sound) return budgets;
  budgets.is_shortened = true;
  budgets.rounds /= kDefectiveShare;
  budgets.growth = kMaxGrowth;
  return budgets;
}

}  // namespace

/// Samples lie closer than what counts as far off.
JudgeOptions plan_judge(const MeshOptions& wishes) {
  const double threshold = wishes.refine_threshold * wishes.sizing.tolerance;
  JudgeOptions judge;
  if (wishes.fit.carve.side != Side::Inside) judge.quads = JudgedQuads::Labeled;
  judge.edge_tolerance = wishes.edge_tolerance;
  judge.corner_tolerance = wishes.corner_tolerance;
  judge.hot_threshold = threshold;
  judge.spacing = std::min(judge.spacing, 1.5 * threshold);
  return judge;
}

StagePlan plan(const MeshOptions& wishes, const Target& target, const Context& context) {
  StagePlan plan;
  plan.sizing = wishes.sizing;
  SizePlan sizes = plan_sizes(wishes, target, context);
  plan.sizes = std::move(sizes.field);
  if (auto& sized = sizes.domain) {
    plan.sizing.domain = std::move(sized->domain);
    // The loop sees where that is too coarse: cells of two sizes cost more than they save.
    if (wishes.sizes.size.is_given() && wishes.fit.carve.side == Side::Inside) {
      plan.sizing.max_level = std::min(plan.sizing.max_level, sized->level);
      plan.sizing.min_level = std::min(plan.sizing.min_level, sized->level);
    }
  }
  plan.complete = wishes.complete;
  plan.even = wishes.even;
  plan.even.max_cells = std::min(wishes.even.max_cells, wishes.max_hexes);
  if (wishes.sizing.sizing != Sizing::Deviation) plan.even.transition_cost = 0;  // the paper's
  plan.dual.mode = dual_mode_of(wishes.complete.pairing);
  plan.fit = wishes.fit;
  plan.fit.tolerance = wishes.sizing.tolerance;
  if (wishes.order == 2) plan.fit.patch_verts = PatchVerts::OnSurface;
  plan.judge = plan_judge(wishes);
  plan.judge.domain = sizes.box;
  plan.budgets = plan_budgets(wishes, target);
  if (wishes.most_hexes > 0)
    for (std::size_t* cells : {&plan.sizing.max_cells, &plan.even.max_cells})
      *cells = std::max(*cells, plan.budgets.background);
  return plan;
}

/// Narrower gaps between parts that nearly coincide are closed.
constexpr double kGapOfTolerance = 0.2;

TargetOptions plan_target(const MeshOptions& wishes) {
  TargetOptions target = wishes.target;
  if (wishes.fit.carve.side != Side::Inside) target.placement = Placement::AsGiven;
  if (target.prepare.min_part < 0)  // what no cell could resolve is no part
    target.prepare.min_part =
        wishes.sizing.sizing == Sizing::Deviation ? wishes.sizing.tolerance : 0.0;
  if (target.prepare.min_gap < 0)
    target.prepare.min_gap =
        wishes.sizing.sizing == Sizing::Deviation ? kGapOfTolerance * wishes.sizing.tolerance : 0.0;
  return target;
}

}  // namespace hexwright
