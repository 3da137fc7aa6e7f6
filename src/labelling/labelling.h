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

namespace hexwright::labelling {

/// A block parity: bit a is set when the block's centre is odd along axis a. 7 = sibling octets.
using Parity = int;
inline constexpr int kNumParities = 8;

/// Forbidden parity pairs of two clusters: bit 8p + q is set when p for the first and q for the
/// second put two blocks in conflict.
using PairTable = std::uint64_t;

struct Conflict {
  std::uint32_t first = 0, second = 0;  ///< clusters, first < second
  PairTable forbidden = 0;
};

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

}  // namespace hexwright::labelling
