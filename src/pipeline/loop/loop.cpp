// Ranks rounds by the demands, refines where they are missed, and ends within the budgets.
#include "pipeline/loop/loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/grid/rescale.h"
#include "hexwright/pipeline/fewest_hexes.h"

#include "pipeline/loop/budgets.h"
#include "pipeline/loop/hex_limit.h"

namespace hexwright {
namespace {

/// Rounds without an improvement after which the loop ends: what still misses is out of its reach.
constexpr int kPatience = 3;

/// The mean falls with the square of the cells' size; aim a little below the goal, for it is an
/// average over shapes that meet the lattice as chance has it.
constexpr double kScaleMargin = 0.98;
constexpr double kLeastScale = 0.6;  // of one step; the next round sees how far it led

/// Whether the demand calls for another round.
bool is_open(const RoundInput& input, const Round& round, const Demand& demand) {
  return demand.is_curable ? demand.is_curable(input, round) : !demand.is_met(input, round);
}

/// Each further grade of a fault is so many times as far off; what is farther than the last grade,
/// a billion times the gate, is all alike.
constexpr double kFarNearer = 4;
constexpr int kLastGrade = 15, kUnusable = kLastGrade + 1;

/// Grades what fails the gate: 0 = nothing, then the distance in multiples of the gate's, a mesh
/// that is empty or has inverted hexes worst. A boundary that touches itself is no worse than a
/// missing part.
int grade_fault(const RoundInput& input, const Round& round) {
  if (is_within_gate(input, round)) return 0;
  if (round.fit.mesh.num_hexes() == 0 || round.verdict.quality.num_inverted > 0) return kUnusable;
  int grade = 1;
  double limit = kFarNearer * kGateFactor * input.options.sizing.tolerance;
  for (; grade < kLastGrade && max_distance(round) > limit; limit *= kFarNearer) ++grade;
  return grade;
}

/// Whether there is nothing to refine for but the distances.
bool is_content_but_for_distance(const RoundInput& input, const Round& round) {
  return std::none_of(demands().begin(), demands().end(), [&](const Demand& demand) {
    return !demand.is_distance && is_open(input, round, demand);
  });
}

/// Leaves that the surface may pass, and those that are meshed: cells elsewhere are carved away.
std::vector<char> find_needed_leaves(const RoundInput& input, const Grid& grid) {
  std::vector<char> is_needed(grid.num_cells(), 1);
  if (input.options.fit.carve.side != Side::Inside) return is_needed;
  parallel_for(
      grid.num_cells(),
      [&](std::size_t i) {
        const Box3 box = cell_box(grid, CellId(i));
        ClosestFilter filter;
        filter.max_distance = 0.5 * box.diagonal();
        is_needed[i] = input.target.tree.closest(box.center(), filter) ||
                       input.target.tree.is_inside(box.center());
      },
      64);
  return is_needed;
}

/// What only minor demands ask for may not cost more than this factor in cells.
constexpr double kMinorGrowth = 1.5;

bool is_worth_its_cells(const RoundInput& input, const Round& round, std::size_t num_next_cells) {
  const bool is_for_more = std::any_of(
      demands().begin(), demands().end(),
      [&](const Demand& demand) { return !demand.is_minor && is_open(input, round, demand); });
  return is_for_more || static_cast<double>(num_next_cells) <=
                            kMinorGrowth * static_cast<double>(round.grid.num_cells());
}

/// The grid for the next round: leaves that hold a miss split, or, where the mean distance alone is
/// missed, all of them a little smaller. Absent when there is nothing to split.
std::optional<Grid> next_grid(const RoundInput& input, const Round& round, const GridFrame& least,
                              RoundRecord& record) {
  if (const auto scale = scale_for_mean(input, round)) {
    record.scale = *scale;
    return rescale_grid(round.grid, *scale, least.root_size, find_needed_leaves(input, round.grid));
  }
  const std::vector<char> marks = mark_misses(input, round);
  record.num_marked = static_cast<std::size_t>(std::count(marks.begin(), marks.end(), 1));
  if (record.num_marked == 0) return {};
  return split_to_sizes(split_cells(round.grid, marks), round.crowded_features,
                        deepest_level(input.options), input.plan.sizes);
}

}  // namespace

bool is_content(const RoundInput& input, const Round& round) {
  return std::none_of(demands().begin(), demands().end(),
                      [&](const Demand& demand) { return is_open(input, round, demand); });
}

bool is_better(const RoundInput& input, const Round& a, const Round& b) {
  const int fault_a = grade_fault(input, a), fault_b = grade_fault(input, b);
  if (fault_a != fault_b) return fault_a < fault_b;
  for (const Demand& demand : demands()) {
    const bool is_met = demand.is_met(input, a);
    if (is_met != demand.is_met(input, b)) return is_met;
  }
  for (const Demand& demand : demands())
    if (demand.shortfall && !demand.is_met(input, a))
      return demand.shortfall(input, a) < demand.shortfall(input, b);
  return a.fit.mesh.num_hexes() < b.fit.mesh.num_hexes();
}

bool is_out_of_proportion(const RoundInput& input, const Round& round, std::size_t num_next_cells) {
  return is_within_gate(input, round) &&
         static_cast<double>(num_next_cells) >
             input.plan.budgets.growth * static_cast<double>(round.grid.num_cells());
}

std::string find_exceeded(const RoundInput& input, const Round& round, std::size_t num_cells,
                          std::size_t num_spent, bool is_split) {
  const Budgets& budgets = input.plan.budgets;
  const auto cells = static_cast<double>(num_cells);
  if (num_cells > budgets.background) return say_exceeded(Budget::Background, cells, budgets);
  if (num_spent + num_cells > budgets.rounds)
    return say_exceeded(Budget::Rounds, cells + static_cast<double>(num_spent), budgets);
  if (is_split && is_out_of_proportion(input, round, num_cells))
    return say_exceeded(Budget::Growth, cells / static_cast<double>(round.grid.num_cells()),
                        budgets);
  return {};
}

std::optional<double> scale_for_mean(const RoundInput& input, const Round& round) {
  const double goal = mean_goal(input.options);
  const bool misses_mean = goal > 0 && mean_distance(round) > goal;
  if (!is_content_but_for_distance(input, round) || !misses_mean) return {};
  const double goal_share = goal / mean_distance(round);
  const double scale = kScaleMargin * std::sqrt(goal_share);
  // A mean that is far off beside a maximum beyond the tolerance comes from places that the grid is
  // too coarse for, not from cells that are a little too large everywhere.
  const double tolerance = input.options.sizing.tolerance;
  const bool mends_maximum = scale >= kLeastScale && max_distance(round) * goal_share <= tolerance;
  if (max_distance(round) > tolerance && !mends_maximum) return {};
  return std::max(kLeastScale, scale);
}

std::vector<Vec3> collect_places(const RoundInput& input, const Round& round, bool minor) {
  std::vector<Vec3> points;
  for (const Demand& demand : demands()) {
    if (!demand.places || demand.is_minor != minor) continue;
    const std::vector<Vec3> places = demand.places(input, round);
    points.insert(points.end(), places.begin(), places.end());
  }
  return points;
}

std::vector<char> mark_splittable(const RoundInput& input, const Grid& grid,
                                  std::span<const Vec3> points) {
  std::vector<char> marks = mark_cells_with_points(grid, points, deepest_level(input.options));
  if (input.plan.sizes.empty()) return marks;
  for (CellId c : grid.cells.ids())
    if (marks[c.index()]) marks[c.index()] = may_split(grid, c, input.plan.sizes);
  return marks;
}

std::vector<char> mark_misses(const RoundInput& input, const Round& round) {
  std::vector<char> marks = mark_splittable(input, round.grid, collect_places(input, round, false));
  if (std::find(marks.begin(), marks.end(), 1) != marks.end()) return marks;
  if (has_expected_topology(input, round))
    return mark_splittable(input, round.grid, collect_places(input, round, true));
  // Near enough everywhere, and still pierced or bridged: at parts and gaps about a cell thick.
  return mark_splittable(input, round.grid, round.fit.report.carve.thin);
}

/// Leaves that are meshed or beside those: what lies farther outside an object whose inside is
/// meshed is carved away.
Grid keep_to_sizes(const RoundInput& input, const Grid& grid) {
  const SizeField& sizes = input.plan.sizes;
  if (sizes.empty()) return grid;
  const SurfaceTree& tree = input.target.tree;
  const auto is_needed = [&](const Box3& box) {
    if (input.options.fit.carve.side != Side::Inside) return true;
    ClosestFilter filter;
    filter.max_distance = 0.8 * box.diagonal();
    return tree.closest(box.center(), filter) || tree.is_inside(box.center());
  };
  return refine_to_sizes(grid, sizes, is_needed, input.plan.budgets.sized);
}

CompleteResult even_out(const RoundInput& input, const Grid& given, bool is_even) {
  const CompleteOptions& options = input.plan.complete;
  EvenOptions even = input.plan.even;
  const Grid grid = keep_to_sizes(input, given);
  if (is_even) even.transition_cost = 0;
  CompleteResult evened =
      even_levels(grid, occupancy_of(input.target.tree), options, even, input.context).completed;
  if (options.pairing != Pairing::Sheets) return evened;
  CompleteResult fewest = complete_with_fewest_hexes(evened.grid, options, input.context);
  fewest.report.num_input_cells = evened.report.num_input_cells;
  fewest.report.num_split_input = evened.report.num_split_input;
  return fewest;
}

Round refine_where_missed(const RoundInput& input, CompleteResult completed, MeshResult& result) {
  const MeshOptions& options = input.options;
  const auto refuse = [&] { throw Error(ErrorCode::OutOfResources, say_beyond_limit(options)); };
  if (!may_be_within_limit(input, completed.grid)) refuse();
  Round current = run_round(input, std::move(completed));
  if (!is_within_limit(input, current)) refuse();
  std::size_t total_hexes = current.record.num_background;
  Round best = current;
  while (true) {
    result.rounds.push_back(current.record);
    if (result.num_rounds >= options.max_rounds || is_content(input, current)) break;
    const std::optional<Grid> finer =
        next_grid(input, current, result.sizing.grid.frame, result.rounds.back());
    if (!finer) break;
    const bool is_split = result.rounds.back().num_marked > 0;
    CompleteResult next = even_out(input, *finer, !is_split);
    if (!is_worth_its_cells(input, current, next.grid.num_cells())) break;
    const std::string exceeded =
        find_exceeded(input, current, next.grid.num_cells(), total_hexes, is_split);
    if (!exceeded.empty()) {
      input.context.warn(
          fmt::format("refinement stops after round {}: {}", result.num_rounds, exceeded));
      break;
    }
    result.is_limited = !may_be_within_limit(input, next.grid);
    if (result.is_limited) break;
    current = run_round(input, std::move(next));
    total_hexes += current.record.num_background;
    ++result.num_rounds;
    result.is_limited = !is_within_limit(input, current);
    if (result.is_limited) {
      result.rounds.push_back(current.record);
      break;
    }
    if (is_better(input, current, best)) {
      best = current;
      result.best_round = result.num_rounds;
    } else if (result.num_rounds - result.best_round >= kPatience) {
      result.rounds.push_back(current.record);
      break;
    }
  }
  return best;
}

}  // namespace hexwright
