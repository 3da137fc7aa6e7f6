// The stages in order, and the loop that refines the grid where the fit missed the surface.
#include "hexwright/pipeline/mesh_surface.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/grid/locate.h"
#include "hexwright/pipeline/plan.h"
#include "hexwright/pipeline/size_plan.h"
#include "hexwright/quality/judge_distance.h"

#include "base/stage_log.h"
#include "mesh/hex_center.h"
#include "pipeline/bodies_apart.h"
#include "pipeline/budget_search.h"
#include "pipeline/cut_by_domain.h"
#include "pipeline/loop/budgets.h"
#include "pipeline/loop/exact_boundary.h"
#include "pipeline/loop/hex_limit.h"
#include "pipeline/loop/loop.h"
#include "pipeline/loop/outer_faces.h"
#include "pipeline/loop/poor_hexes.h"
#include "pipeline/options/size_places.h"
#include "pipeline/shared_budget.h"
#include "pipeline/size_search.h"

namespace hexwright {
namespace {

void record_sizing(const SizingResult& sizing, StageRecord& stage) {
  stage.counts["cells"] = static_cast<double>(sizing.grid.num_cells());
  stage.counts["deepest level"] = sizing.reached_level;
  for (std::size_t r = 0; r < sizing.splits_by_reason.size(); ++r)
    stage.counts[std::string("splits: ") + kSplitReasons[r]] =
        static_cast<double>(sizing.splits_by_reason[r]);
}

/// Completes the a-priori grid; when the result breaks the budget, builds the grid again one level
/// less deep.
CompleteResult complete_within_budget(const RoundInput& input, MeshResult& result) {
  SizingOptions sizing = input.plan.sizing;
  const SizeField& sizes = input.plan.sizes;
  while (true) {
    result.sizing = run_stage(result.stages, "sizing", input.context, [&] {
      return build_grid(input.target, sizing, input.context, sizes.empty() ? nullptr : &sizes);
    });
    record_sizing(result.sizing, result.stages.back());
    CompleteResult completed = run_stage(result.stages, "complete", input.context,
                                         [&] { return even_out(input, result.sizing.grid); });
    result.stages.back().counts["cells"] = static_cast<double>(completed.grid.num_cells());
    if (completed.grid.num_cells() <= input.plan.budgets.background) return completed;
    const std::string exceeded = say_exceeded(
        Budget::Background, static_cast<double>(completed.grid.num_cells()), input.plan.budgets);
    if (sizes.is_exact)
      throw Error(ErrorCode::OutOfResources, exceeded + ", or ask for a larger size");
    if (result.sizing.reached_level <= sizing.min_level)
      throw Error(
          ErrorCode::OutOfResources,
          fmt::format("{}, or lower the minimum level, which is {}", exceeded, sizing.min_level));
    sizing.max_level = result.sizing.reached_level - 1;
    input.context.warn(fmt::format("the grid's levels end at {} instead of {}: {}",
                                   sizing.max_level, result.sizing.reached_level, exceeded));
  }
}

/// Rounding to the input's coordinates can undo validity when the model is far from the origin.
void check_after_mapping(const Similarity& frame, MeshResult& result) {
  // Judged at unit scale: squares of huge or tiny lengths overflow.
  const HexMesh unit = to_unit(result.mesh, frame);
  const std::size_t num_inverted = summarize_quality(unit).num_inverted;
  if (result.verdict.quality.num_inverted == 0 && num_inverted > 0)
    result.failures.push_back(fmt::format(
        "{} hexes are inverted only by rounding to the input's coordinates, which are too far "
        "from the origin for the model's size; move the model nearer to the origin",
        num_inverted));
}

void take_round(Round&& round, MeshResult& result) {
  result.mesh = std::move(round.fit.mesh);
  result.fit = std::move(round.fit.report);
  result.curving = std::move(round.curving);
  result.grid = std::move(round.grid);
  result.verdict = std::move(round.verdict);
  result.complete = std::move(round.complete);
  result.dual = round.dual;
  for (StageRecord& stage : round.stages) result.stages.push_back(std::move(stage));
}

IdVector<HexId, std::int8_t> find_levels(const HexMesh& mesh, const Grid& grid) {
  IdVector<HexId, std::int8_t> levels(mesh.num_hexes(), 0);
  parallel_for(mesh.num_hexes(), [&](std::size_t i) {
    const CellId cell = find_leaf_at(grid, center_of(mesh, HexId(i)));
    if (cell.is_valid()) levels[HexId(i)] = static_cast<std::int8_t>(grid.cells[cell].level);
  });
  return levels;
}

/// Of the result alone: rounds are told apart by what samples say.
void bound_distance(const RoundInput& input, Round& best) {
  if (!best.verdict.distance) return;
  JudgeOptions judged = input.plan.judge;
  judged.bound_gap = kBoundOfTolerance * input.options.sizing.tolerance;
  best.verdict.distance = run_stage(best.stages, "bound", input.context, [&] {
    return judge_distance(best.fit.mesh, input.target, judged);
  });
}

/// Grid, hexes, fit; again where the fit missed. In the world's coordinates.
MeshResult mesh_target(const Target& target, const MeshOptions& options, const Context& context) {
  MeshResult result;
  result.surface = target.diagnosis;
  result.pose = target.frame.pose;
  result.diagonal = target.frame.length_to_world(target.diagonal());
  result.stages = target.stages;
  const StagePlan stages = plan(options, target, context);
  const RoundInput input{target, options, stages, context};
  CompleteResult completed = complete_within_budget(input, result);
  Round best = lift_round(input, refine_where_missed(input, std::move(completed), result));
  record_shape(best, result.rounds[static_cast<std::size_t>(result.best_round)]);
  best = refine_where_poor(input, std::move(best), result);
  best = layer_round(input, std::move(best), result);
  if (options.exact) result.exact = put_on_exact_shape(input, best);
  bound_distance(input, best);
  apply_gate(input, best, result);
  take_round(std::move(best), result);
  result.levels = find_levels(result.mesh, result.grid);
  if (options.fit.carve.side != Side::Inside)
    name_outer_faces(box_of({result.grid.frame, result.grid.roots}), result.mesh);
  result.edges = measure_edges(result.mesh);
  result.options = options;
  result.to_world(target.frame);
  check_after_mapping(target.frame, result);
  return result;
}

/// Passes everything on, and keeps each warning once.
Context collect_warnings(const Context& caller, std::vector<std::string>& warnings) {
  Context context = caller;
  context.on_warning = [&caller, &warnings](std::string_view message) {
    if (std::find(warnings.begin(), warnings.end(), message) != warnings.end()) return;
    warnings.emplace_back(message);
    caller.warn(message);
  };
  return context;
}

/// One of the groups of bodies that are meshed apart. What it says is said of it.
MeshResult mesh_part(const TriMesh& part, const MeshOptions& wishes, const Context& caller,
                     std::size_t number) {
  caller.check_cancelled();
  const std::string whose = fmt::format("group {} (in shares of its own diagonal): ", number);
  Context context = caller;
  context.on_warning = [&](std::string_view said) { caller.warn(whose + std::string(said)); };
  MeshResult result = mesh_target(make_target(part, plan_target(wishes), context), wishes, context);
  // What the judge finds in it he finds in the whole.
  std::erase_if(result.failures, [&](const std::string& failure) {
    return std::ranges::find(result.verdict.failures, failure) != result.verdict.failures.end();
  });
  for (std::string& failure : result.failures) failure = whose + failure;
  return result;
}

/// Bodies that are too near to each other for one grid each by itself, then judged together.
MeshResult mesh_bodies(const Target& target, const MeshOptions& options, const Context& context) {
  const std::vector<TriMesh> parts = split_near_bodies(target, plan_gap(options, target));
  if (parts.empty()) return mesh_target(target, options, context);
  std::vector<MeshResult> results;
  SharedBudget budget(options, parts);
  for (const TriMesh& part : parts) {
    const MeshOptions wishes = budget.allow(plan_part(options, target, part));
    results.push_back(mesh_part(part, wishes, context, results.size() + 1));
    budget.spend(results.back());
  }
  MeshResult result = join_parts(std::move(results), target);
  result.diagonal = target.frame.length_to_world(target.diagonal());
  result.surface = target.diagnosis;
  result.surface.notes.push_back(say_groups(parts.size()));
  JudgeOptions judged = plan_judge(options);
  judged.bound_gap = kBoundOfTolerance * options.sizing.tolerance;
  result.verdict = judge(to_unit(result.mesh, target.frame), target, judged, context);
  const std::vector<std::string>& found = result.verdict.failures;
  result.failures.insert(result.failures.end(), found.begin(), found.end());
  result.verdict.to_world(target.frame);
  result.edges = measure_edges(result.mesh);
  result.options = options;
  return result;
}

}  // namespace

void MeshResult::to_world(const Similarity& frame) {
  mesh = hexwright::to_world(std::move(mesh), frame);
  verdict.to_world(frame);
  grid.frame.to_world(frame);
  sizing.to_world(frame);
  fit.to_world(frame);
  if (curving) curving->to_world(frame);
  layers.to_world(frame);
  edges.to_world(frame);
}

namespace {

/// Then the budget can only be kept or broken.
bool sets_size(const SizeWishes& sizes) { return sizes.size.is_given() || sizes.cells > 0; }

}  // namespace

MeshResult mesh_surface(const TriMesh& surface, const MeshOptions& wishes, const Context& caller) {
  const Stopwatch clock;
  MeshOptions options = resolve_sizes(wishes, surface);
  const SizeWishes asked = options.sizes;
  const auto watch = caller.watch();
  std::vector<std::string> warnings;
  const Context context = collect_warnings(caller, warnings);
  Target target = make_target(surface, plan_target(options), context);
  find_regions(options.sizes.rules, target);
  if (const auto box = find_domain_box(options, object_box(target))) {
    options.sizes.box = box;
    options.sizes.margin.reset();
    cut_by_domain({target.frame.to_unit(box->lo), target.frame.to_unit(box->hi)}, target);
  }
  const auto run = [&](const MeshOptions& sized, const Context& of_run) {
    MeshResult made = mesh_bodies(target, sized, of_run);
    // Bodies apart and layers add to what was counted before.
    if (options.most_hexes > 0 && made.mesh.num_hexes() > options.most_hexes)
      throw Error(ErrorCode::OutOfResources, say_beyond_limit(sized));
    return made;
  };
  MeshResult result = options.most_hexes > 0 && !sets_size(options.sizes)
                          ? search_budget(options, run, context)
                          : search_sizes(target, options, run, context);
  const double diagonal = bounding_box(surface).diagonal();
  result.size_asked = options.sizes.size.in(diagonal);
  result.size_used = result.options.sizes.size.in(diagonal);
  result.options.sizes = asked;
  result.warnings = std::move(warnings);
  result.seconds = clock.seconds();
  return result;
}

}  // namespace hexwright
