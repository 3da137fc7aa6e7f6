// Completion's driver: grid -> nested sets -> one sweep from the deepest depth to the roots ->
// grid.
//
// Based on: Pitzalis et al. 2021, sections 3-5, as docs/algorithms/pairing.md restates them.
// Differs: one integer-free labelling problem per depth; no re-balancing between depths.
#include "hexwright/grid/complete.h"

#include "hexwright/base/assert.h"

#include "grid/balance.h"
#include "grid/blocks.h"
#include "grid/labelling.h"
#include "grid/nested_sets.h"

namespace hexwright {
namespace {

/// Cheapest paired superset of one depth's required nodes.
BrickSet pair_depth(const BrickSet& required, int depth, const LatticeDomain& domain,
                    CompleteReport& report) {
  const Clusters clusters = find_clusters(required);
  const auto costs = block_costs(required, clusters, depth, domain);
  const LabelSolution solution = solve_labels(costs, find_conflicts(required, clusters));
  report.num_clusters += clusters.num_clusters;
  report.largest_group = std::max(report.largest_group, solution.largest_group);
  report.is_optimal_per_depth = report.is_optimal_per_depth && solution.is_optimal;
  report.gap += static_cast<std::size_t>(7 * (solution.cost - solution.lower_bound));
  return blocks_of(required, clusters, solution.labels, depth, domain);
}

NestedSets sweep(const NestedSets& input, const CompleteOptions& options,
                 const LatticeDomain& domain, const Context& context, CompleteReport& report) {
  const int num_depths = static_cast<int>(input.size());
  NestedSets out(input.size());
  for (int d = num_depths - 1; d >= 0; --d) {
    context.check_cancelled();
    const BrickSet required =
        d + 1 < num_depths ? required_above(out[d + 1], d + 1, options.balance, domain, input[d])
                           : input[d];
    switch (options.pairing) {
      case Pairing::None:
      case Pairing::Sheets:
        out[d] = required;
        break;
      case Pairing::Blocks:
        out[d] = pair_depth(required, d, domain, report);
        break;
      case Pairing::Octree:
        out[d] = blocks_of_parity(required, kOctreeParity, d, domain);
        break;
    }
    context.progress("complete", 1 - static_cast<double>(d) / num_depths);
  }
  return out;
}

}  // namespace

CompleteResult complete(const Grid& grid, const CompleteOptions& options, const Context& context) {
  if (const auto issue = grid.find_problem())
    throw Error(ErrorCode::BadArgument, "complete: " + issue->message);
  const LatticeDomain domain(grid.roots, grid.finest_level);
  CompleteResult result;
  CompleteReport& report = result.report;
  const NestedSets input = split_sets_of(grid, domain);
  const NestedSets output = sweep(input, options, domain, context, report);
  for (const BrickSet& set : input) report.num_split_input.push_back(set.num_nodes());
  for (const BrickSet& set : output) report.num_split_output.push_back(set.num_nodes());
  result.grid = grid_of(output, grid, domain);
  report.num_input_cells = grid.num_cells();
  report.num_output_cells = result.grid.num_cells();
  return result;
}

}  // namespace hexwright
