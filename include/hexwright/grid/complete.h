// Makes any adaptive grid hexmeshable: balance and pairing, as coarse as can be.
//
// Based on: Pitzalis, Livesu, Cherchi, Scateni, Gobbetti, "Generalized Adaptive Refinement for
// Grid-based Hexahedral Meshing", ACM TOG 40(6), 2021, sections 3-5, restated as nested sets
// (docs/algorithms/pairing.md).
#pragma once

#include <string>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/grid/grid.h"

namespace hexwright {

enum class Balance {
  Relaxed,  ///< cells sharing a face, edge or vertex differ by at most two levels; for sheets
  Weak,     ///< face neighbours differ by at most one level
  Strong,   ///< cells sharing a face, edge or vertex differ by at most one level
  Auto      ///< what the pairing needs: relaxed for sheets, weak for all others
};

enum class Pairing {
  None,    ///< balance only
  Sheets,  ///< balance only; the dual stage closes its sheets axis by axis
  Blocks,  ///< generalized pairing: 2x2x2 blocks around any lattice vertex (the paper)
  Octree   ///< blocks are sibling octets (Marechal 2009, Gao 2019, Livesu 2021)
};

struct CompleteOptions {
  Balance balance = Balance::Auto;
  Pairing pairing = Pairing::Blocks;
  bool improve =
      true;  ///< after the sweep, descend over cluster labels with the true multi-level cost
};

/// The balance that these options ask for; never Auto.
inline Balance resolve_balance(const CompleteOptions& options) {
  if (options.balance != Balance::Auto) return options.balance;
  return options.pairing == Pairing::Sheets ? Balance::Relaxed : Balance::Weak;
}

/// What completion did, per depth and in all.
struct CompleteReport {
  std::size_t num_input_cells = 0;
  std::size_t num_output_cells = 0;
  std::vector<std::size_t> num_split_input, num_split_output;  ///< split nodes per depth
  std::size_t num_clusters = 0;                                ///< clusters that carried a label
  std::size_t largest_group = 0;                               ///< clusters solved together
  bool is_optimal_per_depth = true;  ///< false when a group was too large for exact search
  std::size_t gap = 0;  ///< cells between the solution and the proven bound, summed over depths
};

struct CompleteResult {
  Grid grid;
  CompleteReport report;
};

/// The coarsest completion found. The input's cells are never coarsened. Same result for any thread
/// count. Errors: BadArgument when `grid.find_problem()`; OutOfResources past kMaxGridLevel.
CompleteResult complete(const Grid& grid, const CompleteOptions& options, const Context& context);

/// First violation of balance (not Auto), with the cells' coordinates; absent when balanced.
std::optional<Issue> find_unbalanced(const Grid& grid, Balance balance);

/// First violation of pairing: finds the block decomposition itself. Absent when paired.
std::optional<Issue> find_unpaired(const Grid& grid);

/// First place where `grid` is coarser than `input`, which it should refine; absent when there is
/// none. Grids of other root cubes, or that lie elsewhere by more than 1e-6 of a root cube, count
/// as a violation too. Throws Error{BadArgument} when `find_problem()` of either.
std::optional<Issue> find_coarsened(const Grid& grid, const Grid& input);

}  // namespace hexwright
