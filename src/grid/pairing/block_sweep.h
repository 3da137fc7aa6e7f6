// The steps of block pairing at one depth, shared by the sweep and the descent.
#pragma once

#include <vector>

#include "hexwright/grid/complete.h"

#include "grid/pairing/blocks.h"
#include "grid/sets/nested_sets.h"
#include "labelling/labelling.h"

namespace hexwright::grids {

/// One depth with everything that decides its labels.
struct DepthProblem {
  BrickSet required;
  Clusters clusters;
  std::vector<LabelCosts> costs;    ///< split nodes per cluster and parity
  std::vector<Conflict> conflicts;  ///< sorted
  LabelSolution solution;           ///< cheapest at this depth alone
};

/// Adds the problem's clusters, groups and gap to the report.
void count_problem(const DepthProblem& problem, CompleteReport& report);

/// Completion by blocks of fixed input sets, one depth at a time.
class BlockSweep {
 public:
  /// The arguments must outlive the sweep.
  BlockSweep(const NestedSets& input, Balance balance, const LatticeDomain& domain)
      : input_(input), balance_(balance), domain_(domain) {}

  int num_depths() const { return static_cast<int>(input_.size()); }
  const NestedSets& input() const { return input_; }

  /// What `depth` must split at least, given what the depth below it splits (ignored for the
  /// deepest).
  BrickSet required(int depth, const BrickSet& split_below) const;

  DepthProblem pose(BrickSet required, int depth) const;
  /// The same, with costs from the cache where it knows them.
  DepthProblem pose(BrickSet required, int depth, ClusterCostCache& cache) const;

  /// What the nodes' clusters cost at least at this depth, each by itself.
  std::int64_t least_cost(const BrickSet& required, int depth) const;

  /// The union of the blocks that the labels choose.
  BrickSet split(const DepthProblem& problem, const std::vector<std::uint8_t>& labels,
                 int depth) const {
    return blocks_of(problem.required, problem.clusters, labels, depth, domain_);
  }

  /// What the blocks of this parity around some nodes require of the depth above, the input left
  /// out. What a union of nodes requires is the union of what each requires.
  BrickSet required_by(const BrickSet& nodes, Parity parity, int depth) const;

 private:
  const NestedSets& input_;
  Balance balance_;
  const LatticeDomain& domain_;
};

}  // namespace hexwright::grids
