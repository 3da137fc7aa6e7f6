// Clusters, their costs and their conflicts, node by node.
#include "grid/pairing/clusters.h"

#include <map>

#include <gtest/gtest.h>

#include "grid/grid_helpers.h"
#include "grid/plain_sets.h"

namespace hexwright {

using namespace grids;

namespace {

using test::bricks_of;
using test::plain;
using test::PlainSet;

/// Required nodes that must choose the same parity: at most two apart, but not (+-2,+-2,+-2).
bool are_related(const LatticeCoord& a, const LatticeCoord& b) {
  int largest = 0, smallest = 9;
  for (int k = 0; k < 3; ++k) {
    largest = std::max(largest, std::abs(a[k] - b[k]));
    smallest = std::min(smallest, std::abs(a[k] - b[k]));
  }
  return largest <= 2 && smallest != 2;
}

using ClusterOfNode = std::map<LatticeCoord, std::uint32_t>;

ClusterOfNode cluster_of_node(const BrickSet& required, const Clusters& clusters) {
  ClusterOfNode out;
  for (const Piece& piece : clusters.pieces)
    for (int bit = 0; bit < 64; ++bit)
      if (piece.bits >> bit & 1) {
        const LatticeCoord node = node_of_bit(required.bricks()[piece.brick].key, bit);
        EXPECT_TRUE(out.emplace(node, piece.cluster).second) << "a node lies in two pieces";
      }
  return out;
}

/// Connected components of are_related(), named by any one of their nodes.
std::map<LatticeCoord, LatticeCoord> components_slowly(const PlainSet& nodes) {
  std::map<LatticeCoord, LatticeCoord> name;
  for (const LatticeCoord& start : nodes) {
    if (name.count(start)) continue;
    std::vector<LatticeCoord> stack = {start};
    name[start] = start;
    while (!stack.empty()) {
      const LatticeCoord n = stack.back();
      stack.pop_back();
      for (const LatticeCoord& m : nodes)
        if (!name.count(m) && are_related(n, m)) {
          name[m] = start;
          stack.push_back(m);
        }
    }
  }
  return name;
}

/// Sparse enough for many clusters, dense enough for large ones.
std::vector<PlainSet> sample_sets(std::mt19937& rng) {
  std::vector<PlainSet> out;
  for (const double share : {0.004, 0.008, 0.012, 0.02})
    for (int k = 0; k < 4; ++k) out.push_back(test::random_nodes(rng, {4, 4, 4}, 16, share));
  return out;
}

// Why relation decides: unrelated nodes can choose freely enough to be separate clusters, related
// ones cannot choose differently at all.
TEST(Clusters, RelatedNodesHaveNoTwoParitiesInPeace) {
  const LatticeCoord a = {8, 8, 8};
  for (int parity_of_a = 0; parity_of_a < 8; ++parity_of_a)
    for (int q = 0; q < 7 * 7 * 7; ++q) {
      const LatticeCoord own = {a[0] + (parity_of_a & 1), a[1] + (parity_of_a >> 1 & 1),
                                a[2] + (parity_of_a >> 2)};
      const LatticeCoord b = {own[0] + q % 7 - 3, own[1] + q / 7 % 7 - 3, own[2] + q / 49 - 3};
      int num_peaceful = 0;
      for (Parity p = 0; p < kNumParities; ++p)
        for (Parity r = 0; r < kNumParities; ++r) {
          const LatticeCoord v = block_center(own, p), w = block_center(b, r);
          num_peaceful += p != r && !is_block_conflict({w[0] - v[0], w[1] - v[1], w[2] - v[2]});
        }
      EXPECT_EQ(num_peaceful == 0, are_related(own, b)) << q;
    }
}

TEST(Clusters, AreTheComponentsOfRelatedNodes) {
  std::mt19937 rng(1);
  for (const PlainSet& nodes : sample_sets(rng)) {
    const BrickSet required = bricks_of(nodes);
    const Clusters clusters = find_clusters(required);
    const ClusterOfNode found = cluster_of_node(required, clusters);
    const auto expected = components_slowly(nodes);
    ASSERT_EQ(found.size(), nodes.size());
    std::map<std::uint32_t, LatticeCoord> name_of_cluster;
    std::set<LatticeCoord> names;
    for (const auto& [node, cluster] : found) {
      const auto [entry, is_new] = name_of_cluster.emplace(cluster, expected.at(node));
      EXPECT_EQ(entry->second, expected.at(node));
      names.insert(expected.at(node));
    }
    EXPECT_EQ(clusters.num_clusters, names.size());
    EXPECT_EQ(name_of_cluster.size(), names.size());
  }
}

TEST(Clusters, PiecesAreSortedByBrickAndNumberedByFirstNode) {
  std::mt19937 rng(2);
  for (const PlainSet& nodes : sample_sets(rng)) {
    const BrickSet required = bricks_of(nodes);
    const Clusters clusters = find_clusters(required);
    ASSERT_EQ(clusters.brick_offset.size(), required.num_bricks() + 1);
    std::uint32_t num_met = 0;
    for (std::uint32_t b = 0; b < required.num_bricks(); ++b) {
      BrickBits all = 0;
      for (std::uint32_t i = clusters.brick_offset[b]; i < clusters.brick_offset[b + 1]; ++i) {
        EXPECT_EQ(clusters.pieces[i].brick, b);
        EXPECT_LE(clusters.pieces[i].cluster, num_met);
        num_met = std::max(num_met, clusters.pieces[i].cluster + 1);
        all |= clusters.pieces[i].bits;
      }
      EXPECT_EQ(all, required.bricks()[b].bits);
    }
    EXPECT_EQ(num_met, clusters.num_clusters);
  }
}

TEST(Clusters, CostTheNodesOfTheirBlocks) {
  std::mt19937 rng(3);
  constexpr int kDepth = 3;
  for (const test::Roots& roots : test::sample_domains()) {
    const LatticeDomain domain(roots, kDepth + 1);
    PlainSet nodes;
    for (const LatticeCoord& root : domain.shifted_roots())
      for (const LatticeCoord& n : test::random_nodes(
               rng, {root[0] << kDepth, root[1] << kDepth, root[2] << kDepth}, 1 << kDepth, 0.02))
        nodes.insert(n);
    const BrickSet required = bricks_of(nodes);
    const Clusters clusters = find_clusters(required);
    const auto costs = block_costs(required, clusters, kDepth, domain);
    std::vector<std::array<PlainSet, kNumParities>> covered(clusters.num_clusters);
    for (const auto& [node, cluster] : cluster_of_node(required, clusters))
      for (Parity p = 0; p < kNumParities; ++p) {
        const LatticeCoord v = block_center(node, p);
        for (int q = 0; q < 8; ++q) {
          const LatticeCoord m = {v[0] - (q & 1), v[1] - (q >> 1 & 1), v[2] - (q >> 2)};
          if (domain.contains(m, kDepth)) covered[cluster][p].insert(m);
        }
      }
    for (std::size_t k = 0; k < clusters.num_clusters; ++k)
      for (Parity p = 0; p < kNumParities; ++p)
        EXPECT_EQ(costs[k][p], static_cast<std::int64_t>(covered[k][p].size()));
  }
}

TEST(Clusters, ConflictsForbidExactlyTheExcludedPairs) {
  std::mt19937 rng(4);
  for (const PlainSet& nodes : sample_sets(rng)) {
    const BrickSet required = bricks_of(nodes);
    const Clusters clusters = find_clusters(required);
    std::map<std::pair<std::uint32_t, std::uint32_t>, PairTable> expected;
    const ClusterOfNode cluster_of = cluster_of_node(required, clusters);
    for (const auto& [a, cluster_a] : cluster_of)
      for (const auto& [b, cluster_b] : cluster_of) {
        if (cluster_a >= cluster_b) continue;
        for (Parity p = 0; p < kNumParities; ++p)
          for (Parity q = 0; q < kNumParities; ++q) {
            const LatticeCoord v = block_center(a, p), w = block_center(b, q);
            if (is_block_conflict({w[0] - v[0], w[1] - v[1], w[2] - v[2]}))
              expected[{cluster_a, cluster_b}] |= PairTable{1} << (8 * p + q);
          }
      }
    const auto conflicts = find_conflicts(required, clusters);
    ASSERT_EQ(conflicts.size(), expected.size());
    auto next = expected.begin();  // both sorted by pair
    for (const Conflict& c : conflicts) {
      EXPECT_EQ(std::make_pair(c.first, c.second), next->first);
      EXPECT_EQ(c.forbidden, next->second);
      for (Parity p = 0; p < kNumParities; ++p)
        EXPECT_FALSE(c.forbidden >> (9 * p) & 1) << "equal parities never exclude each other";
      ++next;
    }
  }
}

}  // namespace
}  // namespace hexwright
