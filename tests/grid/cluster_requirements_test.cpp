// Pricing by clusters against pricing from scratch.
#include "grid/pairing/cluster_requirements.h"

#include <random>

#include <gtest/gtest.h>

#include "grid/grid_helpers.h"

namespace hexwright {

using namespace grids;

namespace {

/// A random grid's sets over each sample domain, with what its sweep needs.
struct Case {
  Grid grid;
  LatticeDomain domain;
  NestedSets sets;

  Case(std::mt19937& rng, const test::Roots& roots)
      : grid(test::random_grid(rng, roots, 5, 0.1)),
        domain(grid.roots, grid.finest_level),
        sets(split_sets_of(grid, domain)) {}
};

TEST(ClusterRequirements, UniteToWhatTheWholeSplitRequires) {
  std::mt19937 rng(1);
  for (const Balance balance : {Balance::Weak, Balance::Strong})
    for (const test::Roots& roots : test::sample_domains()) {
      const Case c(rng, roots);
      const BlockSweep sweep(c.sets, balance, c.domain);
      for (int depth = 1; depth < sweep.num_depths(); ++depth) {
        const DepthProblem problem = sweep.pose(c.sets[static_cast<std::size_t>(depth)], depth);
        ClusterRequirements by_cluster(sweep, problem, depth);
        for (int k = 0; k < 4; ++k) {
          // Any labels, feasible or not: what blocks require does not depend on peace among them.
          std::vector<std::uint8_t> labels(problem.clusters.num_clusters);
          for (auto& label : labels) label = static_cast<std::uint8_t>(rng() % kNumParities);
          EXPECT_EQ(by_cluster.required(labels),
                    sweep.required(depth - 1, sweep.split(problem, labels, depth)));
        }
      }
    }
}

TEST(ClusterCostCache, GivesTheCostsOfBlockCosts) {
  std::mt19937 rng(2);
  for (const test::Roots& roots : test::sample_domains()) {
    ClusterCostCache cache;  // one for all depths and sets, as the descent uses it
    const Case c(rng, roots);
    for (int round = 0; round < 3; ++round)
      for (int depth = 0; depth < c.grid.finest_level; ++depth) {
        const BrickSet& set = c.sets[static_cast<std::size_t>(depth)];
        std::vector<Brick> some(set.bricks().begin(), set.bricks().end());
        if (round > 0)  // drops some nodes, so that most neighbourhoods are known and some are not
          for (Brick& b : some) b.bits &= ~(rng() % 8 == 0 ? BrickBits{0xf0f0} : 0);
        const BrickSet required(std::move(some));
        const Clusters clusters = find_clusters(required);
        EXPECT_EQ(cache.costs(required, clusters, depth, c.domain),
                  block_costs(required, clusters, depth, c.domain));
      }
  }
}

TEST(BlockSweep, LeastCostIsABoundForEveryLabelling) {
  std::mt19937 rng(3);
  for (const test::Roots& roots : test::sample_domains()) {
    const Case c(rng, roots);
    const BlockSweep sweep(c.sets, Balance::Weak, c.domain);
    for (int depth = 0; depth < sweep.num_depths(); ++depth) {
      const BrickSet& required = c.sets[static_cast<std::size_t>(depth)];
      const DepthProblem problem = sweep.pose(required, depth);
      const std::int64_t least = sweep.least_cost(required, depth);
      EXPECT_LE(least, problem.solution.cost);
      const BrickSet split = sweep.split(problem, problem.solution.labels, depth);
      EXPECT_EQ(static_cast<std::int64_t>(split.num_nodes()), problem.solution.cost)
          << "a cost counts the nodes of the blocks";
    }
  }
}

}  // namespace
}  // namespace hexwright
