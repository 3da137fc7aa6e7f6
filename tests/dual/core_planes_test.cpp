// Core planes and the split nodes they belong to, node by node.
#include "dual/domain/core_planes.h"

#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "dual/dual_helpers.h"

namespace hexwright::dual {
namespace {

using test::box_roots;
using NodeSet = std::set<LatticeCoord>;

Domain domain_of(const std::vector<LatticeCoord>& roots) {
  return Domain(test::grid_of_splits(roots, {}));
}

NodeSet random_nodes(std::mt19937& rng, const std::vector<LatticeCoord>& roots, int depth,
                     double share) {
  std::uniform_real_distribution<> uniform(0, 1);
  NodeSet out;
  const int edge = 1 << depth;
  for (const LatticeCoord& r : roots)
    for (int q = 0; q < edge * edge * edge; ++q)
      if (uniform(rng) < share)
        out.insert(
            {r[0] * edge + q % edge, r[1] * edge + q / edge % edge, r[2] * edge + q / edge / edge});
  return out;
}

SplitNodes split_nodes_of(const NodeSet& nodes) {
  SplitNodes out;
  for (const LatticeCoord& n : nodes) out.insert(n);
  return out;
}

/// Nodes that share at least a vertex, and so on: each node's cluster by one of its nodes.
std::map<LatticeCoord, LatticeCoord> clusters_slowly(const NodeSet& nodes) {
  std::map<LatticeCoord, LatticeCoord> name;
  for (const LatticeCoord& start : nodes) {
    std::vector<LatticeCoord> stack;
    if (name.emplace(start, start).second) stack.push_back(start);
    while (!stack.empty()) {
      const LatticeCoord n = stack.back();
      stack.pop_back();
      for (int q = 0; q < 27; ++q) {
        const LatticeCoord m = {n[0] + q % 3 - 1, n[1] + q / 3 % 3 - 1, n[2] + q / 9 - 1};
        if (nodes.count(m) && name.emplace(m, start).second) stack.push_back(m);
      }
    }
  }
  return name;
}

/// The node on the other side of a node's core face.
LatticeCoord partner_of(LatticeCoord node, int axis, int parity) {
  node[axis] += (node[axis] & 1) == parity ? -1 : 1;
  return node;
}

/// Partners of a cluster that would be cut: [axis][parity].
using CutCounts = std::array<std::array<std::size_t, 2>, 3>;

std::map<LatticeCoord, CutCounts> cuts_slowly(const NodeSet& nodes, int depth,
                                              const Domain& domain) {
  std::map<LatticeCoord, CutCounts> cuts;
  for (const auto& [node, cluster] : clusters_slowly(nodes))
    for (int a = 0; a < 3; ++a)
      for (int parity = 0; parity < 2; ++parity) {
        const LatticeCoord partner = partner_of(node, a, parity);
        cuts[cluster][a][parity] += !nodes.count(partner) && domain.contains_node(partner, depth);
      }
  return cuts;
}

int parity_at(const SplitNodes& nodes, const LatticeCoord& node) {
  return nodes.groups()[static_cast<std::size_t>(nodes.find_group(parent_of(node)))].parity;
}

const std::vector<std::vector<LatticeCoord>>& domains() {
  static const std::vector<std::vector<LatticeCoord>> all = {
      box_roots(1, 1, 1), box_roots(2, 1, 3), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  return all;
}

TEST(SplitNodes, AnswersAsASetOfNodes) {
  std::mt19937 rng(1);
  for (int k = 0; k < 20; ++k) {
    const NodeSet nodes = random_nodes(rng, box_roots(2, 2, 2), 2, 0.02 * k);
    const SplitNodes split = split_nodes_of(nodes);
    EXPECT_EQ(split.num_nodes(), nodes.size());
    for (int q = 0; q < 12 * 12 * 12; ++q) {
      const LatticeCoord n = {q % 12 - 2, q / 12 % 12 - 2, q / 144 - 2};
      EXPECT_EQ(split.contains(n), nodes.count(n) != 0);
      // The point in the middle of the node, and its low corner.
      bool touches_corner = false;
      for (int c = 0; c < 8; ++c)
        touches_corner |= nodes.count({n[0] - (c & 1), n[1] - (c >> 1 & 1), n[2] - (c >> 2)}) != 0;
      const LatticeCoord corner = {2 * n[0], 2 * n[1], 2 * n[2]};
      EXPECT_EQ(split.find_group_around(corner) >= 0, touches_corner);
      EXPECT_EQ(split.find_group_around({corner[0] + 1, corner[1] + 1, corner[2] + 1}) >= 0,
                nodes.count(n) != 0);
    }
  }
}

TEST(CorePlanes, CutTheFewestPartnersOfEveryCluster) {
  std::mt19937 rng(2);
  for (const auto& roots : domains())
    for (int k = 0; k < 20; ++k) {
      const int depth = 1 + k % 3;
      const Domain domain = domain_of(roots);
      const NodeSet nodes = random_nodes(rng, roots, depth, 0.03 + 0.05 * (k % 5));
      SplitNodes split = split_nodes_of(nodes);
      const CorePlaneReport report = choose_core_planes(split, depth, domain, {});
      std::size_t least = 0;
      for (const auto& [cluster, cut] : cuts_slowly(nodes, depth, domain))
        for (int a = 0; a < 3; ++a) {
          least += std::min(cut[a][0], cut[a][1]);
          EXPECT_EQ(cut[a][parity_at(split, cluster) >> a & 1], std::min(cut[a][0], cut[a][1]));
        }
      EXPECT_EQ(report.num_partners, least);
    }
}

TEST(CorePlanes, AllNodesOfAClusterAgree) {
  std::mt19937 rng(3);
  for (int k = 0; k < 20; ++k) {
    const auto roots = box_roots(2, 2, 2);
    const NodeSet nodes = random_nodes(rng, roots, 2, 0.04);
    SplitNodes split = split_nodes_of(nodes);
    choose_core_planes(split, 2, domain_of(roots), {});
    for (const auto& [node, cluster] : clusters_slowly(nodes))
      EXPECT_EQ(parity_at(split, node), parity_at(split, cluster));
  }
}

TEST(CorePlanes, KeepClearOfVerticesToAvoid) {
  std::mt19937 rng(4);
  const auto roots = box_roots(2, 2, 2);
  const Domain domain = domain_of(roots);
  const std::vector<LatticeCoord> avoid = {{1, 1, 1}};
  int num_moved = 0;
  for (int k = 0; k < 40; ++k) {
    const int depth = 1 + k % 2;
    NodeSet nodes = random_nodes(rng, roots, depth, 0.1);
    const std::int32_t at = 1 << depth;
    nodes.insert({at - 1, at, at});  // touches the vertex
    SplitNodes split = split_nodes_of(nodes), free = split;
    choose_core_planes(free, depth, domain, {});
    choose_core_planes(split, depth, domain, avoid);
    for (int a = 0; a < 3; ++a)
      EXPECT_NE(parity_at(split, {at - 1, at, at}) >> a & 1, at & 1) << "axis " << a;
    num_moved += parity_at(free, {at - 1, at, at}) != parity_at(split, {at - 1, at, at});
  }
  EXPECT_GT(num_moved, 0);
}

TEST(CorePlanes, OfPairedGridsCutNothing) {
  std::mt19937 rng(5);
  for (int k = 0; k < 20; ++k) {
    const auto roots = box_roots(2, 2, 1);
    const Domain domain = domain_of(roots);
    const int parity = k % 8;
    NodeSet nodes;  // blocks of one parity
    for (const LatticeCoord& n : random_nodes(rng, roots, 2, 0.05))
      for (int q = 0; q < 8; ++q) {
        LatticeCoord m = n;
        for (int a = 0; a < 3; ++a)
          if (q >> a & 1) m = partner_of(m, a, parity >> a & 1);
        if (domain.contains_node(m, 2)) nodes.insert(m);
      }
    SplitNodes split = split_nodes_of(nodes);
    EXPECT_EQ(choose_core_planes(split, 2, domain, {}).num_partners, 0u) << "parity " << parity;
  }
}

}  // namespace
}  // namespace hexwright::dual
