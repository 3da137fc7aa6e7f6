// Descent over cluster labels with the true cost over all depths.
//
// The sweep picks, at each depth, labels that are cheapest there; another choice may force fewer
// nodes at coarser depths. The descent goes from the deepest depth to the roots like the sweep, and
// at each depth tries other labels for single clusters, for groups and for all clusters, completing
// the coarser depths by the plain sweep to learn what each choice costs in all.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "grid/pairing/block_sweep.h"

namespace hexwright::grids {

class Descent {
 public:
  Descent(const BlockSweep& sweep, const Context& context);

  /// Split nodes of the best completion found; never more than the plain sweep's. Counts clusters
  /// and groups in the report.
  NestedSets run(CompleteReport& report);

 private:
  /// Changes to the labels of one depth: these clusters take this parity.
  struct Move {
    std::vector<std::uint32_t> clusters;
    Parity parity = 0;
    std::int64_t cost = 0;  ///< of this depth after the move
  };

  std::vector<std::uint8_t> choose_labels(const DepthProblem& problem, int depth);
  std::vector<Move> list_moves(const DepthProblem& problem, const std::vector<std::uint8_t>& labels,
                               std::size_t max_clusters) const;
  bool try_moves(const DepthProblem& problem, int depth, std::vector<std::uint8_t>& labels,
                 std::int64_t& best_total);

  /// Split nodes of all depths above `depth` after it splits `split`; at least `limit` when that
  /// much is certain before the end.
  std::int64_t cost_above(const BrickSet& split, int depth, std::int64_t limit);
  /// As cost_above(), of this depth and all above, given what it must split.
  std::int64_t cost_from(BrickSet required, int depth, std::int64_t limit);
  /// Lower bound on the split nodes of the depths 0 .. depth - 1.
  std::int64_t bound_above(int depth) const { return bound_above_[depth]; }
  void compute_bounds();
  void spend(const BrickSet& set) { work_ += set.num_bricks() + kWorkPerSet; }

  static constexpr std::size_t kWorkPerSet = 8;  ///< fixed cost of a step, in bricks

  const BlockSweep& sweep_;
  const Context& context_;
  std::vector<std::int64_t> bound_above_;
  std::unordered_map<std::uint64_t, std::int64_t> cost_of_required_;  ///< by hash; exact costs only
  ClusterCostCache cluster_costs_;
  std::size_t work_ = 0, budget_ = 0;
};

}  // namespace hexwright::grids
