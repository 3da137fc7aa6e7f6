// The steps of block pairing at one depth.
#include "grid/pairing/block_sweep.h"

#include <algorithm>

#include "grid/pairing/balance.h"

namespace hexwright::grids {
namespace {

void solve(DepthProblem& problem) {
  problem.conflicts = find_conflicts(problem.required, problem.clusters);
  problem.solution = solve_labels(problem.costs, problem.conflicts);
}

}  // namespace

BrickSet BlockSweep::required(int depth, const BrickSet& split_below) const {
  if (depth + 1 == num_depths()) return input_[depth];
  return required_above(split_below, depth + 1, balance_, domain_, input_[depth]);
}

DepthProblem BlockSweep::pose(BrickSet required, int depth) const {
  DepthProblem out;
  out.required = std::move(required);
  out.clusters = find_clusters(out.required);
  out.costs = block_costs(out.required, out.clusters, depth, domain_);
  solve(out);
  return out;
}

DepthProblem BlockSweep::pose(BrickSet required, int depth, ClusterCostCache& cache) const {
  DepthProblem out;
  out.required = std::move(required);
  out.clusters = find_clusters(out.required);
  out.costs = cache.costs(out.required, out.clusters, depth, domain_);
  solve(out);
  return out;
}

BrickSet BlockSweep::required_by(const BrickSet& nodes, Parity parity, int depth) const {
  return required_above(blocks_of_parity(nodes, parity, depth, domain_), depth, balance_, domain_,
                        BrickSet());
}

std::int64_t BlockSweep::least_cost(const BrickSet& required, int depth) const {
  std::int64_t total = 0;
  for (const LabelCosts& c : block_costs(required, find_clusters(required), depth, domain_))
    total += *std::min_element(c.begin(), c.end());
  return total;
}

void count_problem(const DepthProblem& problem, CompleteReport& report) {
  const LabelSolution& solution = problem.solution;
  report.num_clusters += problem.clusters.num_clusters;
  report.largest_group = std::max(report.largest_group, solution.largest_group);
  report.is_optimal_per_depth = report.is_optimal_per_depth && solution.is_optimal;
  report.gap += static_cast<std::size_t>(7 * (solution.cost - solution.lower_bound));
}

}  // namespace hexwright::grids
