// From leaves to split nodes and back.
#include "grid/sets/nested_sets.h"

#include <gtest/gtest.h>

#include "hexwright/base/parallel.h"

#include "grid/grid_helpers.h"
#include "grid/plain_sets.h"

namespace hexwright {

using namespace grids;

namespace {

TEST(NestedSets, AreTheAncestorsOfTheLeaves) {
  std::mt19937 rng(1);
  for (const test::Roots& roots : test::sample_domains()) {
    const Grid grid = test::random_grid(rng, roots, 4);
    const LatticeDomain domain(grid.roots, grid.finest_level);
    const NestedSets sets = split_sets_of(grid, domain);
    const test::PlainSets expected = test::plain_split_sets(grid);
    ASSERT_EQ(sets.size(), expected.size());
    for (int d = 0; d < grid.finest_level; ++d) {
      test::PlainSet found;
      for (const LatticeCoord& n : test::plain(sets[d])) found.insert(domain.unshifted(n, d));
      EXPECT_EQ(found, expected[d]) << "depth " << d;
    }
  }
}

TEST(NestedSets, GiveTheGridBack) {
  std::mt19937 rng(2);
  for (const test::Roots& roots : test::sample_domains())
    for (int rounds = 0; rounds <= 5; ++rounds) {
      const Grid grid = test::random_grid(rng, roots, rounds);
      const LatticeDomain domain(grid.roots, grid.finest_level);
      const Grid again = grid_of(split_sets_of(grid, domain), grid, domain);
      EXPECT_EQ(again.cells, grid.cells);
      EXPECT_EQ(again.finest_level, grid.finest_level);
    }
}

// Large enough for several chunks of leaves, several tasks of output and large pages.
TEST(NestedSets, AreTheSameForEveryThreadCountOnALargeGrid) {
  std::mt19937 rng(3);
  Grid grid = make_root_grid({});
  for (int k = 0; k < 6; ++k) grid = split_cells(grid, std::vector<char>(grid.num_cells(), 1));
  std::vector<char> marks(grid.num_cells());
  for (char& m : marks) m = rng() % 2 == 0;
  grid = split_cells(grid, marks);
  const LatticeDomain domain(grid.roots, grid.finest_level);
  for (const int threads : {1, 2, 3}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(grid.find_problem(), std::nullopt);
    const Grid again = grid_of(split_sets_of(grid, domain), grid, domain);
    EXPECT_TRUE(again.cells == grid.cells);
  }
}

}  // namespace
}  // namespace hexwright
