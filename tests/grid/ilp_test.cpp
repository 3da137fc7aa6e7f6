// The exact sweep against the integer programs, and those against exhaustive search.
#include <gtest/gtest.h>

#if HEXWRIGHT_HAS_ILP
#include <cmath>
#include <random>

#include "hexwright/base/error.h"
#include "hexwright/grid/ilp.h"

#include "grid/grid_helpers.h"
#include "grid/ilp/ilp_program.h"
#include "grid/pairing/blocks.h"
#include "labelling/labelling.h"

namespace hexwright {

using namespace grids;

namespace {

using test::random_grid;
using test::Roots;
using test::sample_domains;

/// Every node of a depth's lattice.
BrickSet all_nodes(const LatticeDomain& domain, int depth) {
  std::vector<Brick> bricks;
  const int n = 1 << depth;
  for (const LatticeCoord& root : domain.shifted_roots())
    for (int i = 0; i < n * n * n; ++i) {
      const LatticeCoord c = {root[0] * n + i % n, root[1] * n + i / n % n,
                              root[2] * n + i / n / n};
      bricks.push_back({brick_of_node(c), BrickBits{1} << bit_of_node(c)});
    }
  return BrickSet(std::move(bricks));
}

BrickSet random_subset(std::mt19937& rng, const BrickSet& nodes, double share) {
  std::uniform_real_distribution<> uniform(0, 1);
  std::vector<Brick> bricks(nodes.bricks().begin(), nodes.bricks().end());
  for (Brick& b : bricks) {
    BrickBits kept = 0;
    for (BrickBits rest = b.bits; rest != 0; rest &= rest - 1)
      if (uniform(rng) < share) kept |= rest & (~rest + 1);
    b.bits = kept;
  }
  return BrickSet(std::move(bricks));
}

std::int64_t least_nodes_by_labels(const BrickSet& required, int depth,
                                   const LatticeDomain& domain) {
  const Clusters clusters = find_clusters(required);
  const LabelSolution s = solve_labels(block_costs(required, clusters, depth, domain),
                                       find_conflicts(required, clusters));
  EXPECT_TRUE(s.is_optimal);
  const BrickSet split = blocks_of(required, clusters, s.labels, depth, domain);
  EXPECT_EQ(static_cast<std::int64_t>(split.num_nodes()), s.cost);
  return s.cost;
}

TEST(Ilp, LabellingEqualsTheFullProgramAtOneDepth) {
  std::mt19937 rng(1);
  int num_instances = 0, num_conflicted = 0;
  for (int k = 0; k < 45; ++k)
    for (std::size_t shape = 0; shape < sample_domains().size(); ++shape) {
      // Small lattices with every density, and a few 8x8x8 ones with several clusters.
      const int depth = shape == 0 ? (k % 22 == 0 ? 3 : 2) : 1 + (k % 15 == 1 && shape != 3);
      const LatticeDomain domain(test::unsplit_grid(sample_domains()[shape]).roots, depth + 1);
      const BrickSet nodes = all_nodes(domain, depth);
      const double share = depth == 3 ? 0.008 : 0.02 + 0.03 * (k % 5);
      const BrickSet required = random_subset(rng, nodes, share);
      if (required.empty()) continue;
      const IlpSolution ilp = solve_depth_program(required, nodes, depth, domain, 60, nullptr);
      ASSERT_TRUE(ilp.is_optimal);
      EXPECT_EQ(static_cast<std::int64_t>(std::lround(ilp.objective)),
                least_nodes_by_labels(required, depth, domain))
          << "shape " << shape << " round " << k;
      ++num_instances;
      const Clusters clusters = find_clusters(required);
      num_conflicted += !find_conflicts(required, clusters).empty();
    }
  EXPECT_GE(num_instances, 200);
  EXPECT_GE(num_conflicted, 20);
}

TEST(Ilp, WholeHierarchyIsNeverAboveTheDescent) {
  std::mt19937 rng(2);
  for (int k = 0; k < 8; ++k)
    for (const Roots& roots : sample_domains()) {
      const Grid grid = random_grid(rng, roots, 2 + k % 2, 0.03);
      const Balance balance = k % 2 ? Balance::Strong : Balance::Weak;
      const IlpResult global = complete_by_ilp(grid, {balance, IlpScope::Hierarchy, 60}, {});
      ASSERT_TRUE(global.is_optimal);
      EXPECT_EQ(global.lower_bound, global.num_cells);
      EXPECT_FALSE(global.grid.find_problem());
      EXPECT_FALSE(find_unbalanced(global.grid, balance));
      EXPECT_FALSE(find_unpaired(global.grid));
      EXPECT_LE(global.num_cells,
                complete(grid, {balance, Pairing::Blocks, true}, {}).grid.num_cells());
      const IlpResult depthwise = complete_by_ilp(grid, {balance, IlpScope::Depth, 60}, {});
      ASSERT_TRUE(depthwise.is_optimal);
      EXPECT_FALSE(find_unbalanced(depthwise.grid, balance));
      EXPECT_FALSE(find_unpaired(depthwise.grid));
      EXPECT_LE(global.num_cells, depthwise.num_cells);
    }
}

TEST(Ilp, RejectsWhatBlocksAreNotDefinedFor) {
  const Grid grid = test::unsplit_grid({{0, 0, 0}});
  EXPECT_THROW(complete_by_ilp(grid, {Balance::Relaxed, IlpScope::Depth, 1}, {}), Error);
  Grid broken = grid;
  broken.cells.clear();
  EXPECT_THROW(complete_by_ilp(broken, {Balance::Weak, IlpScope::Depth, 1}, {}), Error);
}

TEST(Ilp, TellsItsSolver) { EXPECT_EQ(ilp_solver_name().rfind("HiGHS ", 0), 0u); }

}  // namespace
}  // namespace hexwright
#else
TEST(Ilp, LabellingEqualsTheFullProgramAtOneDepth) {
  GTEST_SKIP() << "needs HiGHS: run scripts/setup, then configure again";
}
#endif
