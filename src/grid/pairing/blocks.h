// Grows required nodes to 2x2x2 blocks.
#pragma once

#include <vector>

#include "grid/pairing/clusters.h"

namespace hexwright::grids {

/// The blocks of one parity that cover a brick's nodes; entry n is what lands in neighbour n.
std::array<BrickBits, 27> grow_to_blocks(BrickBits w, Parity parity);

/// Union of the clusters' blocks, clipped to the domain. One label per cluster.
BrickSet blocks_of(const BrickSet& required, const Clusters& clusters,
                   const std::vector<std::uint8_t>& labels, int depth, const LatticeDomain& domain);

/// Union of the blocks of one parity for all nodes.
BrickSet blocks_of_parity(const BrickSet& required, Parity parity, int depth,
                          const LatticeDomain& domain);

}  // namespace hexwright::grids
