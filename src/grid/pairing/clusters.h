// Clusters of required nodes: the nodes that must carry one common block parity.
//
// Based on: docs/algorithms/pairing.md, section "The program collapses". Two required nodes with
// max|offset| <= 2, offset not (+-2,+-2,+-2), are always covered by blocks of equal parity; the
// connected components of that relation are the clusters.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "grid/sets/brick_set.h"
#include "grid/sets/lattice_domain.h"
#include "labelling/labelling.h"

namespace hexwright::grids {

using labelling::Conflict;
using labelling::kNumParities;
using labelling::LabelCosts;
using labelling::LabelSolution;
using labelling::PairTable;
using labelling::Parity;
using labelling::solve_labels;

inline constexpr Parity kOctreeParity = 7;  ///< sibling octets

/// The nodes of one cluster inside one brick (a brick may hold several clusters).
struct Piece {
  std::uint32_t brick = 0;  ///< position in the set's bricks()
  std::uint32_t cluster = 0;
  BrickBits bits = 0;
};

/// Clusters of one depth, numbered by their first node in brick order.
struct Clusters {
  std::vector<Piece> pieces;                ///< sorted by brick
  std::vector<std::uint32_t> brick_offset;  ///< pieces of brick b: brick_offset[b] .. [b+1]-1
  std::size_t num_clusters = 0;
};

Clusters find_clusters(const BrickSet& required);

/// Per cluster and parity: number of domain nodes in the blocks that cover the cluster.
std::vector<std::array<std::int64_t, kNumParities>> block_costs(const BrickSet& required,
                                                                const Clusters& clusters, int depth,
                                                                const LatticeDomain& domain);

/// As block_costs(), but remembers what the pieces of a brick cost by a hash of the nodes in and
/// around it: for many small problems that differ in a few places.
class ClusterCostCache {
 public:
  using PieceCosts = std::array<std::int32_t, kNumParities>;

  std::vector<std::array<std::int64_t, kNumParities>> costs(const BrickSet& required,
                                                            const Clusters& clusters, int depth,
                                                            const LatticeDomain& domain);

 private:
  std::unordered_map<std::uint64_t, PieceCosts> known_;
};

/// Pairs of clusters that cannot choose freely, sorted.
std::vector<Conflict> find_conflicts(const BrickSet& required, const Clusters& clusters);

/// Centre of the block of the given parity that covers a node.
constexpr LatticeCoord block_center(const LatticeCoord& node, Parity parity) {
  LatticeCoord v = node;
  for (int a = 0; a < 3; ++a) v[a] += (node[a] ^ parity >> a) & 1;
  return v;
}

/// Whether blocks whose centres differ by `offset` exclude each other: closer than four, not all
/// components even, and not (+-3,+-3,+-3). These are the 98 + 210 exclusions of the paper.
constexpr bool is_block_conflict(const LatticeCoord& offset) {
  int largest = 0, smallest = 4, odd = 0;
  for (const std::int32_t o : offset) {
    const int size = o < 0 ? -o : o;
    largest = size > largest ? size : largest;
    smallest = size < smallest ? size : smallest;
    odd |= size & 1;
  }
  return largest <= 3 && odd != 0 && smallest != 3;
}

}  // namespace hexwright::grids
