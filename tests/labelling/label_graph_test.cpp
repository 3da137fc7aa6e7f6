// The parts of the labelling solver one by one, against exhaustive search.
#include "labelling/label_graph.h"

#include <random>

#include <gtest/gtest.h>

#include "random_conflicts.h"

namespace hexwright::labelling {
namespace {

/// A random graph of few nodes: costs with ties, some labels missing, unequal labels in conflict.
LabelGraph random_graph(std::mt19937& rng, std::uint32_t num_nodes, double edge_share,
                        bool drops_labels) {
  LabelGraph graph;
  graph.edges.resize(num_nodes);
  for (std::uint32_t u = 0; u < num_nodes; ++u) {
    LabelCosts costs;
    for (auto& c : costs) c = kLeafCost * static_cast<std::int64_t>(1 + rng() % 6);
    graph.costs.push_back(costs);
    graph.allowed.push_back(drops_labels ? static_cast<LabelMask>(1 + rng() % 255) : 0xff);
  }
  test::add_conflicts(rng, graph, edge_share, 3);
  return graph;
}

std::int64_t cost_of(const LabelGraph& graph, const std::vector<std::uint8_t>& labels) {
  std::int64_t total = 0;
  for (std::size_t u = 0; u < labels.size(); ++u) total += graph.costs[u][labels[u]];
  return total;
}

template <class Visit>
void for_each_labelling(std::size_t num_nodes, Visit&& visit) {
  std::vector<std::uint8_t> labels(num_nodes);
  for (std::size_t code = 0; code < std::size_t{1} << (3 * num_nodes); ++code) {
    for (std::size_t k = 0; k < num_nodes; ++k)
      labels[k] = static_cast<std::uint8_t>(code >> (3 * k) & 7);
    visit(labels);
  }
}

std::int64_t least_cost_slowly(const LabelGraph& graph) {
  std::int64_t least = kInfeasibleCost;
  for_each_labelling(graph.num_nodes(), [&](const auto& labels) {
    if (test::is_feasible(graph, labels)) least = std::min(least, cost_of(graph, labels));
  });
  return least;
}

TEST(LabelGraph, GroupsAreTheConnectedNodes) {
  std::mt19937 rng(1);
  for (int k = 0; k < 50; ++k) {
    const LabelGraph graph = random_graph(rng, 20, 0.02 + 0.002 * k, false);
    const auto groups = find_groups(graph);
    std::vector<int> group_of(graph.num_nodes(), -1);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      EXPECT_GE(groups[g].size(), 2u);
      EXPECT_TRUE(std::is_sorted(groups[g].begin(), groups[g].end()));
      for (const std::uint32_t u : groups[g]) {
        EXPECT_EQ(group_of[u], -1);
        group_of[u] = static_cast<int>(g);
      }
    }
    for (std::size_t u = 0; u < graph.num_nodes(); ++u) {
      EXPECT_EQ(group_of[u] < 0, graph.edges[u].empty());
      for (const LabelEdge& e : graph.edges[u]) EXPECT_EQ(group_of[u], group_of[e.other]);
    }
  }
}

TEST(LabelGraph, ReducingKeepsAnOptimum) {
  std::mt19937 rng(2);
  for (int k = 0; k < 60; ++k) {
    const LabelGraph graph = random_graph(rng, 4, 0.2 + 0.1 * (k % 8), k % 2 == 1);
    LabelGraph reduced = graph;
    reduce_graph(reduced, find_groups(graph));
    const std::int64_t least = least_cost_slowly(graph);
    if (least == kInfeasibleCost) continue;  // nothing to keep
    EXPECT_EQ(least_cost_slowly(reduced), least);
    for (std::size_t u = 0; u < graph.num_nodes(); ++u) {
      EXPECT_EQ(reduced.allowed[u] & ~graph.allowed[u], 0);
      if (graph.edges[u].empty()) {
        EXPECT_EQ(std::popcount(unsigned{reduced.allowed[u]}), 1);
      }
    }
  }
}

TEST(LabelGraph, ReplacingPrunedLabelsInOrderKeepsALabellingFeasible) {
  std::mt19937 rng(3);
  std::size_t num_replaced = 0;
  for (int k = 0; k < 20; ++k) {
    const LabelGraph graph = random_graph(rng, 4, 0.6, false);
    LabelGraph reduced = graph;
    const auto pruned = reduce_graph(reduced, find_groups(graph));
    for_each_labelling(graph.num_nodes(), [&](const auto& before) {
      if (!test::is_feasible(graph, before)) return;
      auto labels = before;
      for (const PrunedLabel& step : pruned)
        if (labels[step.node] == step.label) {
          labels[step.node] = step.better;
          ++num_replaced;
        }
      EXPECT_TRUE(test::is_feasible(graph, labels));
      EXPECT_LE(cost_of(graph, labels), cost_of(graph, before));
    });
  }
  EXPECT_GT(num_replaced, 0u);
}

TEST(LabelGraph, EveryExactMethodFindsTheLeastCost) {
  std::mt19937 rng(4);
  for (int k = 0; k < 60; ++k) {
    const LabelGraph graph = random_graph(rng, 2 + k % 4, 0.9, k % 3 == 0);
    const std::int64_t least = least_cost_slowly(graph);
    const auto eliminated = solve_by_elimination(graph, std::size_t{1} << 16);
    ASSERT_TRUE(eliminated);
    EXPECT_EQ(eliminated->cost, least);
    if (least == kInfeasibleCost) continue;
    EXPECT_TRUE(test::is_feasible(graph, eliminated->labels));
    EXPECT_EQ(cost_of(graph, eliminated->labels), least);
    if (k % 3 == 0) continue;  // make_start() wants all labels
    const SearchResult searched = solve_by_search(graph, make_start(graph), 1'000'000);
    EXPECT_TRUE(searched.is_optimal);
    EXPECT_EQ(searched.best.cost, least);
    EXPECT_EQ(searched.lower_bound, least);
    EXPECT_TRUE(test::is_feasible(graph, searched.best.labels));
    const SearchResult large = solve_large_group(graph, make_start(graph), std::size_t{1} << 16);
    EXPECT_TRUE(test::is_feasible(graph, large.best.labels));
    EXPECT_EQ(large.best.cost, least);
    EXPECT_TRUE(large.is_optimal);
  }
}

TEST(LabelGraph, PartsOnlyImprove) {
  std::mt19937 rng(5);
  int num_improved = 0;
  for (int k = 0; k < 30; ++k) {
    const LabelGraph graph = random_graph(rng, 40, 0.08, false);
    Labelling labelling = make_start(graph);
    EXPECT_TRUE(test::is_feasible(graph, labelling.labels));
    EXPECT_EQ(labelling.cost, cost_of(graph, labelling.labels));
    const std::int64_t before = labelling.cost;
    improve_by_parts(graph, labelling);
    EXPECT_TRUE(test::is_feasible(graph, labelling.labels));
    EXPECT_EQ(labelling.cost, cost_of(graph, labelling.labels));
    EXPECT_LE(labelling.cost, before);
    num_improved += labelling.cost < before;
  }
  EXPECT_GT(num_improved, 0);
}

TEST(LabelGraph, ASubgraphIsTheGroupRenumbered) {
  std::mt19937 rng(6);
  const LabelGraph graph = random_graph(rng, 24, 0.06, true);
  const auto groups = find_groups(graph);
  ASSERT_FALSE(groups.empty());
  std::vector<std::uint32_t> local(graph.num_nodes());
  for (const auto& group : groups)
    for (std::uint32_t i = 0; i < group.size(); ++i) local[group[i]] = i;
  for (const auto& group : groups) {
    const LabelGraph alone = subgraph(graph, group, local);
    ASSERT_EQ(alone.num_nodes(), group.size());
    for (std::size_t i = 0; i < group.size(); ++i) {
      EXPECT_EQ(alone.costs[i], graph.costs[group[i]]);
      EXPECT_EQ(alone.allowed[i], graph.allowed[group[i]]);
      ASSERT_EQ(alone.edges[i].size(), graph.edges[group[i]].size());
      for (std::size_t k = 0; k < alone.edges[i].size(); ++k) {
        EXPECT_EQ(group[alone.edges[i][k].other], graph.edges[group[i]][k].other);
        EXPECT_EQ(alone.edges[i][k].forbids, graph.edges[group[i]][k].forbids);
      }
    }
  }
}

}  // namespace
}  // namespace hexwright::labelling
