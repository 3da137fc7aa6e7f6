// Chooses one parity per cluster: least total cost without a forbidden pair.
//
// Equal labels never exclude each other, so a solution always exists. Most clusters are alone or
// lose all but one label to dominance; the rest is solved exactly by variable elimination, or by
// branch and bound where elimination tables would be too large. Only past the search limit is the
// answer a bound with a gap.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grid/clusters.h"

namespace hexwright {

using LabelCosts = std::array<std::int64_t, kNumParities>;

struct LabelLimits {
  std::size_t table_entries = std::size_t{1} << 16;  ///< largest elimination table
  std::size_t search_nodes = 200'000;                ///< branch-and-bound nodes per group
};

struct LabelSolution {
  std::vector<std::uint8_t> labels;  ///< parity per cluster
  std::size_t largest_group = 0;     ///< clusters in the largest connected group of conflicts
  bool is_optimal = true;
  std::int64_t cost = 0;
  std::int64_t lower_bound = 0;  ///< equals cost when optimal
};

/// Deterministic: among equal costs the choice depends on the arguments alone. Conflicts sorted by
/// (first, second), one entry per pair.
LabelSolution solve_labels(const std::vector<LabelCosts>& costs,
                           const std::vector<Conflict>& conflicts, const LabelLimits& limits = {});

}  // namespace hexwright
