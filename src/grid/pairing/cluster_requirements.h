// What single clusters require of the depth above, so that a candidate labelling that moves a few
// clusters is priced by a union of lists instead of growing every node anew.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "grid/pairing/block_sweep.h"

namespace hexwright::grids {

class ClusterRequirements {
 public:
  /// Of the problem's clusters at `depth` >= 1. The arguments must outlive the object.
  ClusterRequirements(const BlockSweep& sweep, const DepthProblem& problem, int depth);

  /// Equal to sweep.required(depth - 1, sweep.split(problem, labels, depth)).
  BrickSet required(const std::vector<std::uint8_t>& labels);

 private:
  const BrickSet& required_by(std::size_t cluster, Parity parity);

  const BlockSweep& sweep_;
  int depth_;
  std::vector<BrickSet> nodes_;  ///< of each cluster
  /// Per cluster and parity, filled when first asked for.
  std::vector<std::array<std::optional<BrickSet>, kNumParities>> required_by_;
};

}  // namespace hexwright::grids
