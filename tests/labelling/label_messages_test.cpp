// Bounds by messages and the search that uses them, against exhaustive search.
#include "labelling/label_messages.h"

#include <random>

#include <gtest/gtest.h>

#include "random_conflicts.h"

namespace hexwright::labelling {
namespace {

/// Costs as multiples of `step`, and random exclusions of unequal labels on a random graph.
LabelGraph random_graph(std::mt19937& rng, std::uint32_t num_nodes, double edge_share, int step,
                        unsigned keep_one_in) {
  LabelGraph graph;
  graph.edges.resize(num_nodes);
  graph.allowed.assign(num_nodes, 0xff);
  for (std::uint32_t u = 0; u < num_nodes; ++u) {
    LabelCosts c{};
    for (Parity p = 0; p < kNumParities; ++p)
      c[p] = static_cast<std::int64_t>(step * (1 + rng() % 9)) * kLeafCost +
             std::popcount(static_cast<unsigned>(p));
    graph.costs.push_back(c);
  }
  test::add_conflicts(rng, graph, edge_share, keep_one_in);
  return graph;
}

std::int64_t cost_of(const LabelGraph& graph, const std::vector<std::uint8_t>& labels) {
  std::int64_t total = 0;
  for (std::size_t u = 0; u < labels.size(); ++u) total += graph.costs[u][labels[u]];
  return total;
}

/// Least cost of all labellings, and of those with each label at each node.
struct LeastCosts {
  std::int64_t least = kInfeasibleCost;
  std::vector<LabelCosts> with_label;
};

LeastCosts least_costs_slowly(const LabelGraph& graph) {
  const std::size_t n = graph.num_nodes();
  LeastCosts out;
  out.with_label.resize(n);
  for (LabelCosts& row : out.with_label) row.fill(kInfeasibleCost);
  for (std::size_t code = 0; code < std::size_t{1} << (3 * n); ++code) {
    std::vector<std::uint8_t> labels(n);
    for (std::size_t k = 0; k < n; ++k) labels[k] = static_cast<std::uint8_t>(code >> (3 * k) & 7);
    if (!test::is_feasible(graph, labels)) continue;
    const std::int64_t cost = cost_of(graph, labels);
    out.least = std::min(out.least, cost);
    for (std::size_t k = 0; k < n; ++k)
      out.with_label[k][labels[k]] = std::min(out.with_label[k][labels[k]], cost);
  }
  return out;
}

TEST(LabelMessages, BoundsHoldForEveryLabelAndNeverFall) {
  std::mt19937 rng(1);
  int num_tight = 0;
  for (int k = 0; k < 40; ++k) {
    const LabelGraph graph = random_graph(rng, 2 + k % 4, 0.7, 1 + k % 3, 2 + k % 4);
    const LeastCosts exact = least_costs_slowly(graph);
    LabelMessages messages(graph);
    std::int64_t before = 0;
    for (int pass = 0; pass < 40; ++pass) {
      ASSERT_TRUE(messages.pass(pass % 2 == 0));
      EXPECT_GE(messages.bound(), before);
      before = messages.bound();
      ASSERT_LE(messages.bound(), exact.least / kLeafCost);
    }
    num_tight += before == exact.least / kLeafCost;
    // Whoever drops a label must be right: nothing below a limit has it.
    for (const std::int64_t above : {0, 1, 3, 9}) {
      const std::int64_t limit = exact.least / kLeafCost + above;
      LabelMessages dropped = messages;
      dropped.drop_labels_from(limit);
      for (std::size_t u = 0; u < graph.num_nodes(); ++u)
        for (Parity p = 0; p < kNumParities; ++p)
          if (!(dropped.allowed(u) >> p & 1)) {
            EXPECT_GE(exact.with_label[u][p] / kLeafCost, limit);
          }
    }
  }
  EXPECT_GT(num_tight, 25);
}

TEST(LabelMessages, FindThatLabelsExcludeEachOther) {
  // Two nodes that exclude all pairs, equal ones too.
  std::mt19937 rng(2);
  LabelGraph graph = random_graph(rng, 3, 1, 1, 1000);
  for (auto& edges : graph.edges)
    for (LabelEdge& e : edges) e.forbids.fill(0xff);
  EXPECT_FALSE(LabelMessages(graph).pass(true));
}

TEST(LabelMessages, CostsBeyondTheCapOnlyWeakenTheBound) {
  std::mt19937 rng(3);
  for (int k = 0; k < 10; ++k) {
    const LabelGraph graph = random_graph(rng, 4, 0.8, 5000, 3);
    const LeastCosts exact = least_costs_slowly(graph);
    LabelMessages messages(graph);
    for (int pass = 0; pass < 200; ++pass) ASSERT_TRUE(messages.pass(pass % 2 == 0));
    EXPECT_LE(messages.bound(), exact.least / kLeafCost);
    EXPECT_GT(messages.bound(), 0);
  }
}

TEST(LargeGroup, IsSolvedOrItsGapIsKnown) {
  std::mt19937 rng(4);
  int num_optimal = 0;
  for (int k = 0; k < 40; ++k) {
    const LabelGraph graph = random_graph(rng, 5, 0.6, 1 + k % 8, 2 + k % 3);
    const std::int64_t least = least_costs_slowly(graph).least / kLeafCost;
    Labelling start{std::vector<std::uint8_t>(5, 7), 0};
    start.cost = cost_of(graph, start.labels);
    for (const std::size_t table_entries : {std::size_t{0}, std::size_t{1} << 16}) {
      const SearchResult result = solve_large_group(graph, start, table_entries);
      EXPECT_TRUE(test::is_feasible(graph, result.best.labels));
      EXPECT_EQ(result.best.cost, cost_of(graph, result.best.labels));
      EXPECT_LE(result.lower_bound / kLeafCost, least);
      EXPECT_GE(result.best.cost / kLeafCost, least);
      EXPECT_TRUE(!result.is_optimal || result.best.cost / kLeafCost == least);
      EXPECT_TRUE(result.is_optimal || table_entries == 0);
      num_optimal += result.is_optimal;
    }
  }
  EXPECT_GT(num_optimal, 70);
}

TEST(LargeGroup, AThousandClustersComeOutWithASmallGap) {
  // A long chain, along which messages must travel.
  std::mt19937 rng(5);
  LabelGraph graph = random_graph(rng, 1000, 0, 8, 2);
  for (std::uint32_t i = 0; i < 1000; ++i)
    for (std::uint32_t j = i + 1; j < std::min(1000u, i + 3); ++j) {
      LabelEdge forward{j, {}}, backward{i, {}};
      for (Parity p = 0; p < kNumParities; ++p)
        for (Parity q = 0; q < kNumParities; ++q)
          if (p != q && rng() % 4 == 0) {
            forward.forbids[p] = static_cast<LabelMask>(forward.forbids[p] | 1 << q);
            backward.forbids[q] = static_cast<LabelMask>(backward.forbids[q] | 1 << p);
          }
      graph.edges[i].push_back(forward);
      graph.edges[j].push_back(backward);
    }
  Labelling start{std::vector<std::uint8_t>(1000, 0), 0};
  start.cost = cost_of(graph, start.labels);
  const SearchResult by_messages = solve_large_group(graph, start, 0);
  EXPECT_TRUE(test::is_feasible(graph, by_messages.best.labels));
  const double gap = static_cast<double>(by_messages.best.cost - by_messages.lower_bound) /
                     static_cast<double>(by_messages.best.cost);
  EXPECT_LT(gap, 0.1);
  // The chain is narrow, so elimination can tell the truth.
  const auto exact = solve_by_elimination(graph, std::size_t{1} << 16);
  ASSERT_TRUE(exact);
  EXPECT_LE(by_messages.lower_bound / kLeafCost, exact->cost / kLeafCost);
  EXPECT_GE(by_messages.best.cost / kLeafCost, exact->cost / kLeafCost);
}

TEST(Elimination, GivesUpBeforeItsTablesGrow) {
  std::mt19937 rng(6);
  const LabelGraph graph = random_graph(rng, 30, 1, 1, 2);
  EXPECT_FALSE(solve_by_elimination(graph, 1 << 12));
}

TEST(Elimination, SaysWhenNoLabellingExists) {
  std::mt19937 rng(7);
  LabelGraph graph = random_graph(rng, 4, 1, 1, 1000);  // only equal labels go together
  graph.allowed = {0x0f, 0xf0, 0xff, 0xff};
  const auto result = solve_by_elimination(graph, 1 << 12);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->cost, kInfeasibleCost);
  graph.allowed[2] = 0;
  EXPECT_EQ(solve_by_elimination(graph, 1 << 12)->cost, kInfeasibleCost);
}

}  // namespace
}  // namespace hexwright::labelling
