// The labelling solver against exhaustive search.
#include "labelling/labelling.h"

#include <random>

#include <gtest/gtest.h>

#include "labelling/label_graph.h"

namespace hexwright::labelling {
namespace {

struct Problem {
  std::vector<LabelCosts> costs;
  std::vector<Conflict> conflicts;
};

/// Random costs; conflicts forbid random unequal pairs.
Problem random_problem(std::mt19937& rng, std::uint32_t num_clusters, double edge_share) {
  Problem out;
  std::uniform_real_distribution<> uniform(0, 1);
  for (std::uint32_t k = 0; k < num_clusters; ++k) {
    LabelCosts c;
    for (auto& x : c) x = static_cast<std::int64_t>(1 + rng() % 40);
    out.costs.push_back(c);
  }
  for (std::uint32_t i = 0; i < num_clusters; ++i)
    for (std::uint32_t j = i + 1; j < num_clusters; ++j) {
      if (uniform(rng) > edge_share) continue;
      PairTable table = 0;
      for (int p = 0; p < 8; ++p)
        for (int q = 0; q < 8; ++q)
          if (p != q && rng() % 4 != 0) table |= PairTable{1} << (8 * p + q);
      out.conflicts.push_back({i, j, table});
    }
  return out;
}

bool is_feasible(const Problem& problem, const std::vector<std::uint8_t>& labels) {
  for (const Conflict& c : problem.conflicts)
    if (c.forbidden >> (8 * labels[c.first] + labels[c.second]) & 1) return false;
  return true;
}

std::int64_t cost_of(const Problem& problem, const std::vector<std::uint8_t>& labels) {
  std::int64_t total = 0;
  for (std::size_t k = 0; k < labels.size(); ++k) total += problem.costs[k][labels[k]];
  return total;
}

std::int64_t least_cost_slowly(const Problem& problem) {
  const std::size_t n = problem.costs.size();
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (std::size_t code = 0; code < std::size_t{1} << (3 * n); ++code) {
    std::vector<std::uint8_t> labels(n);
    for (std::size_t k = 0; k < n; ++k) labels[k] = static_cast<std::uint8_t>(code >> (3 * k) & 7);
    if (is_feasible(problem, labels)) least = std::min(least, cost_of(problem, labels));
  }
  return least;
}

void expect_solves(const Problem& problem, const LabelLimits& limits, std::int64_t least) {
  const LabelSolution s = solve_labels(problem.costs, problem.conflicts, limits);
  EXPECT_TRUE(s.is_optimal);
  EXPECT_TRUE(is_feasible(problem, s.labels));
  EXPECT_EQ(s.cost, cost_of(problem, s.labels));
  EXPECT_EQ(s.cost, least);
  EXPECT_EQ(s.lower_bound, least);
}

TEST(Labelling, EliminationAndSearchFindTheOptimum) {
  std::mt19937 rng(1);
  for (int k = 0; k < 60; ++k) {
    const Problem problem = random_problem(rng, 1 + k % 5, 0.3 + 0.1 * (k % 8));
    const std::int64_t least = least_cost_slowly(problem);
    expect_solves(problem, {}, least);
    expect_solves(problem, {.table_entries = 0}, least);  // branch and bound alone
  }
}

TEST(Labelling, EliminationAgreesWithSearchOnLargerGroups) {
  std::mt19937 rng(2);
  for (int k = 0; k < 30; ++k) {
    const Problem problem = random_problem(rng, 12, 0.25);
    const LabelSolution a = solve_labels(problem.costs, problem.conflicts);
    const LabelSolution b = solve_labels(problem.costs, problem.conflicts, {.table_entries = 0});
    ASSERT_TRUE(a.is_optimal && b.is_optimal);
    EXPECT_EQ(a.cost, b.cost);
    EXPECT_TRUE(is_feasible(problem, a.labels));
    EXPECT_TRUE(is_feasible(problem, b.labels));
  }
}

TEST(Labelling, PastItsLimitsReportsAGap) {
  std::mt19937 rng(3);
  int num_open = 0;
  for (int k = 0; k < 20; ++k) {
    const Problem problem = random_problem(rng, 14, 0.8);
    const std::int64_t least = solve_labels(problem.costs, problem.conflicts).cost;
    const LabelSolution s =
        solve_labels(problem.costs, problem.conflicts, {.table_entries = 0, .search_nodes = 5});
    EXPECT_TRUE(is_feasible(problem, s.labels));
    EXPECT_LE(s.lower_bound, least);
    EXPECT_GE(s.cost, least);
    num_open += !s.is_optimal;
  }
  EXPECT_GT(num_open, 0);
}

TEST(Labelling, HugeGroupsGetAFeasibleLabellingAndABound) {
  // A 6x6x6 grid of clusters, each in conflict with its neighbours along the axes.
  std::mt19937 rng(4);
  constexpr std::uint32_t kEdge = 6;
  Problem problem = random_problem(rng, kEdge * kEdge * kEdge, 0);
  for (std::uint32_t i = 0; i < problem.costs.size(); ++i)
    for (const std::uint32_t step : {1u, kEdge, kEdge * kEdge}) {
      if (i / step % kEdge == kEdge - 1) continue;
      PairTable table = 0;
      for (int p = 0; p < 8; ++p)
        for (int q = 0; q < 8; ++q)
          if (p != q && rng() % 4 == 0) table |= PairTable{1} << (8 * p + q);
      problem.conflicts.push_back({i, i + step, table});
    }
  const LabelSolution s = solve_labels(problem.costs, problem.conflicts);
  EXPECT_EQ(s.largest_group, problem.costs.size());
  EXPECT_FALSE(s.is_optimal);
  EXPECT_TRUE(is_feasible(problem, s.labels));
  EXPECT_EQ(s.cost, cost_of(problem, s.labels));
  EXPECT_LT(s.lower_bound, s.cost);
  std::int64_t least_alone = 0, best_uniform = std::numeric_limits<std::int64_t>::max();
  for (const LabelCosts& c : problem.costs) least_alone += *std::min_element(c.begin(), c.end());
  for (std::uint8_t p = 0; p < 8; ++p)
    best_uniform = std::min(best_uniform,
                            cost_of(problem, std::vector<std::uint8_t>(problem.costs.size(), p)));
  EXPECT_GT(s.lower_bound, least_alone);
  EXPECT_LT(s.cost, best_uniform);
}

TEST(Labelling, LargestGroupCountsConnectedClusters) {
  Problem problem;
  problem.costs.resize(6);
  for (auto& c : problem.costs) c = {1, 2, 3, 4, 5, 6, 7, 8};
  problem.conflicts = {{0, 1, ~PairTable{0} & ~0x8040201008040201}, {1, 4, 2}};
  const LabelSolution s = solve_labels(problem.costs, problem.conflicts);
  EXPECT_EQ(s.largest_group, 3u);
  EXPECT_EQ(s.cost, 6);
}

}  // namespace
}  // namespace hexwright::labelling
