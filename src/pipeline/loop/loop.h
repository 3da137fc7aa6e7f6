// The loop: rounds until all demands are met, each on a grid refined where the last one missed.
#pragma once

#include "pipeline/loop/demands.h"

namespace hexwright {

/// Whether nothing is left to refine for: every demand is met, or beyond cure.
bool is_content(const RoundInput& input, const Round& round);

/// Whether a next grid of so many cells would break the plan's Budgets::growth.
bool is_out_of_proportion(const RoundInput& input, const Round& round, std::size_t num_next_cells);

/// The budget that a next grid of so many cells would exceed, as a sentence; empty = none. Spent:
/// by the rounds so far. Only where cells are split may it be out of proportion.
std::string find_exceeded(const RoundInput& input, const Round& round, std::size_t num_cells,
                          std::size_t num_spent, bool is_split);

/// Whether `a` is the better result. Beyond the gate the one without inverted hexes, then one that
/// is several times nearer. Then the first demand that only one of them meets decides. When
/// both meet the same, the shortfall of the first that is missed decides; when none is missed by
/// an amount, the smaller mesh.
bool is_better(const RoundInput& input, const Round& a, const Round& b);

/// How much smaller all cells must become for the mean distance to reach its goal, when nothing
/// else is missed that this would not mend.
std::optional<double> scale_for_mean(const RoundInput& input, const Round& round);

/// Where the demands, those that are minor or the others, call for finer cells.
std::vector<Vec3> collect_places(const RoundInput& input, const Round& round, bool minor);

/// Leaves that hold a point and may be split: of the grid, 1 or 0 each.
std::vector<char> mark_splittable(const RoundInput& input, const Grid& grid,
                                  std::span<const Vec3> points);

/// Leaves of the completed grid that hold the demands' places; when there are none but the topology
/// is not the surface's, those of thin parts and gaps.
std::vector<char> mark_misses(const RoundInput& input, const Round& round);

/// Completes a grid, with its levels evened out where transitions cost more than they save, unless
/// they are as even as they should be.
CompleteResult even_out(const RoundInput& input, const Grid& grid, bool is_even = false);

/// Fits, measures, splits leaves that hold a miss, and repeats while that is called for and
/// affordable. Needs `sizing` of the result, and fills its rounds. Returns the best
/// round.
Round refine_where_missed(const RoundInput& input, CompleteResult completed, MeshResult& result);

}  // namespace hexwright
