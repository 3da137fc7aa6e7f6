// Requirements of single clusters and their unions.
//
// Growing by blocks, by neighbours and to parents distributes over unions of nodes (rule (B) in
// docs/algorithms/pairing.md speaks of single nodes), so what a labelling requires is the union of
// what each cluster requires for its own label, united with the input.
#include "grid/pairing/cluster_requirements.h"

namespace hexwright::grids {

ClusterRequirements::ClusterRequirements(const BlockSweep& sweep, const DepthProblem& problem,
                                         int depth)
    : sweep_(sweep), depth_(depth) {
  const std::size_t num_clusters = problem.clusters.num_clusters;
  std::vector<std::vector<Brick>> bricks(num_clusters);
  for (const Piece& piece : problem.clusters.pieces)
    bricks[piece.cluster].push_back({problem.required.bricks()[piece.brick].key, piece.bits});
  for (auto& list : bricks) nodes_.emplace_back(std::move(list));
  required_by_.resize(num_clusters);
}

const BrickSet& ClusterRequirements::required_by(std::size_t cluster, Parity parity) {
  auto& known = required_by_[cluster][parity];
  if (!known) known = sweep_.required_by(nodes_[cluster], parity, depth_);
  return *known;
}

BrickSet ClusterRequirements::required(const std::vector<std::uint8_t>& labels) {
  const auto input = sweep_.input()[static_cast<std::size_t>(depth_ - 1)].bricks();
  std::vector<Brick> bricks(input.begin(), input.end());
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const auto own = required_by(k, labels[k]).bricks();
    bricks.insert(bricks.end(), own.begin(), own.end());
  }
  return BrickSet(std::move(bricks));
}

}  // namespace hexwright::grids
