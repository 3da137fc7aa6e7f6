// Properties of completion on random grids over several domains.
#include "hexwright/grid/complete.h"

#include <random>

#include <gtest/gtest.h>

#include "hexwright/base/parallel.h"

#include "grid/grid_helpers.h"
#include "grid/sets/pose.h"
#include "helpers.h"

namespace hexwright {

using namespace grids;

namespace {

using test::plain_split_sets;
using test::PlainSets;
using test::random_grid;
using test::Roots;
using test::sample_domains;

constexpr Balance kBalances[] = {Balance::Weak, Balance::Strong};
constexpr Pairing kPairings[] = {Pairing::None, Pairing::Sheets, Pairing::Blocks, Pairing::Octree};

Grid completed(const Grid& grid, Balance balance, Pairing pairing, bool improve = true) {
  return complete(grid, {balance, pairing, improve}, {}).grid;
}

/// Calls body(grid, balance) for random grids over every sample domain.
template <class Body>
void for_random_grids(int seed, int count, Body&& body) {
  std::mt19937 rng(static_cast<unsigned>(seed));
  for (int k = 0; k < count; ++k)
    for (const Roots& roots : sample_domains()) {
      SCOPED_TRACE(testing::Message()
                   << "seed " << seed << " round " << k << " roots " << roots.size());
      const double share = 0.02 + 0.1 * static_cast<double>(rng() % 4);
      const Grid grid = random_grid(rng, roots, 2 + k % 3, share);
      for (const Balance balance : kBalances) body(grid, balance);
    }
}

bool is_nowhere_coarser(const Grid& fine, const Grid& coarse) {
  const PlainSets a = plain_split_sets(fine), b = plain_split_sets(coarse);
  if (a.size() < b.size()) return false;
  for (std::size_t d = 0; d < b.size(); ++d)
    if (!std::includes(a[d].begin(), a[d].end(), b[d].begin(), b[d].end())) return false;
  return true;
}

TEST(Complete, ResultIsBalancedPairedAndNowhereCoarser) {
  for_random_grids(1, 6, [](const Grid& grid, Balance balance) {
    for (const Pairing pairing : kPairings) {
      const Grid out = completed(grid, balance, pairing);
      ASSERT_FALSE(out.find_problem()) << out.find_problem()->message;
      EXPECT_TRUE(is_nowhere_coarser(out, grid));
      const auto unbalanced = find_unbalanced(out, balance);
      EXPECT_FALSE(unbalanced) << unbalanced->message;
      if (pairing == Pairing::None || pairing == Pairing::Sheets) continue;
      const auto unpaired = find_unpaired(out);
      EXPECT_FALSE(unpaired) << unpaired->message;
    }
  });
}

TEST(Complete, RelaxedBalanceAllowsTwoLevels) {
  for_random_grids(8, 6, [](const Grid& grid, Balance stricter) {
    const Grid out = completed(grid, Balance::Relaxed, Pairing::Sheets);
    EXPECT_FALSE(find_unbalanced(out, Balance::Relaxed));
    EXPECT_TRUE(is_nowhere_coarser(out, grid));
    EXPECT_TRUE(stricter == Balance::Weak ||
                is_nowhere_coarser(completed(grid, stricter, Pairing::Sheets), out));
    EXPECT_EQ(completed(out, Balance::Relaxed, Pairing::Sheets).cells, out.cells);
    EXPECT_THROW(completed(grid, Balance::Relaxed, Pairing::Blocks), Error);
  });
}

TEST(Complete, IsIdempotent) {
  for_random_grids(2, 5, [](const Grid& grid, Balance balance) {
    for (const Pairing pairing : kPairings) {
      const Grid once = completed(grid, balance, pairing);
      EXPECT_EQ(completed(once, balance, pairing).cells, once.cells);
    }
  });
}

TEST(Complete, BlocksNeverCostMoreThanOctreePairing) {
  for_random_grids(3, 6, [](const Grid& grid, Balance balance) {
    EXPECT_LE(completed(grid, balance, Pairing::Blocks).num_cells(),
              completed(grid, balance, Pairing::Octree).num_cells());
  });
}

TEST(Complete, DescentNeverCostsCells) {
  for_random_grids(7, 6, [](const Grid& grid, Balance balance) {
    EXPECT_LE(completed(grid, balance, Pairing::Blocks, true).num_cells(),
              completed(grid, balance, Pairing::Blocks, false).num_cells());
  });
}

TEST(Complete, ReportCountsWhatTheGridHolds) {
  for_random_grids(4, 2, [](const Grid& grid, Balance balance) {
    const CompleteResult result = complete(grid, {balance, Pairing::Blocks, true}, {});
    const PlainSets in = plain_split_sets(grid), out = plain_split_sets(result.grid);
    EXPECT_EQ(result.report.num_input_cells, grid.num_cells());
    EXPECT_EQ(result.report.num_output_cells, result.grid.num_cells());
    ASSERT_EQ(result.report.num_split_output.size(), out.size());
    for (std::size_t d = 0; d < out.size(); ++d) {
      EXPECT_EQ(result.report.num_split_input[d], in[d].size());
      EXPECT_EQ(result.report.num_split_output[d], out[d].size());
    }
    EXPECT_TRUE(result.report.is_optimal_per_depth);
    EXPECT_EQ(result.report.gap, 0u);
  });
}

/// The grid seen in a pose and moved by whole roots.
Grid posed_grid(const Grid& grid, const Pose& pose, const LatticeCoord& move) {
  Roots roots;
  const auto image = [&](const LatticeCoord& index, int level) {
    LatticeCoord out;
    for (int a = 0; a < 3; ++a) {
      const std::int32_t x = index[pose.axis[a]];
      out[a] = (pose.flip[a] ? -1 - x : x) + move[a] * (1 << level);
    }
    return out;
  };
  for (const LatticeCoord& root : grid.roots) roots.push_back(image(root, 0));
  auto specs = test::specs_of(grid);
  for (CellSpec& spec : specs) spec.index = image(spec.index, spec.level);
  return make_grid(grid.frame, roots, specs);
}

TEST(Complete, CountIsTheSameInAllPosesAndAfterEvenMoves) {
  std::mt19937 rng(8);
  int num_distinct = 0;
  for (int k = 0; k < 6; ++k)
    for (const Roots& roots : sample_domains()) {
      const Grid grid = random_grid(rng, roots, 3 + k % 2, 0.04);
      for (const Pairing pairing : {Pairing::Blocks, Pairing::Octree}) {
        const Balance balance = k % 2 ? Balance::Strong : Balance::Weak;
        const std::size_t expected = completed(grid, balance, pairing).num_cells();
        for (int n = 0; n < 48; n += 1 + (k + n) % 5) {
          const LatticeCoord move = {2 * (n % 3), -2 * (n % 5), 2};
          const Grid posed = posed_grid(grid, make_pose(n), move);
          EXPECT_EQ(completed(posed, balance, pairing).num_cells(), expected) << "pose " << n;
          num_distinct += posed.cells != grid.cells;
        }
      }
    }
  EXPECT_GT(num_distinct, 500);
}

TEST(Complete, SameResultForEveryThreadCount) {
  std::mt19937 rng(5);
  const Grid grid = random_grid(rng, sample_domains()[3], 6, 0.6);
  ASSERT_GT(grid.num_cells(), 100'000u);
  const auto run = [&](int threads) {
    ThreadLimit limit(threads);
    return completed(grid, Balance::Weak, Pairing::Blocks);
  };
  const Grid one = run(1);
  EXPECT_EQ(run(2).cells, one.cells);
  EXPECT_EQ(run(3).cells, one.cells);
}

TEST(Complete, UnsplitGridsStayUnsplit) {
  for (const Roots& roots : sample_domains()) {
    const Grid grid = test::unsplit_grid(roots);
    for (const Pairing pairing : kPairings)
      EXPECT_EQ(completed(grid, Balance::Strong, pairing).cells, grid.cells);
  }
}

TEST(Complete, KeepsTheFrame) {
  Grid grid = test::unsplit_grid(sample_domains()[1]);
  grid.frame = {{1, 2, 3}, 0.25};
  grid = split_cells(grid, {1, 0, 0});
  EXPECT_EQ(completed(grid, Balance::Weak, Pairing::Blocks).frame, grid.frame);
}

TEST(Complete, DeepestLevelsAndFarRootsWork) {
  Grid grid = test::unsplit_grid({{-1024, 7, 1023}});
  for (int level = 0; level < kMaxGridLevel; ++level) {
    std::vector<char> marks(grid.num_cells(), 0);
    marks[marks.size() / 2] = 1;
    grid = split_cells(grid, marks);
  }
  const Grid out = completed(grid, Balance::Strong, Pairing::Blocks);
  EXPECT_FALSE(out.find_problem());
  EXPECT_FALSE(find_unbalanced(out, Balance::Strong));
  EXPECT_FALSE(find_unpaired(out));
}

TEST(Complete, RejectsBrokenAndOversizedGrids) {
  Grid broken = test::unsplit_grid({{0, 0, 0}});
  broken.cells.clear();
  EXPECT_THROW(complete(broken, {}, {}), Error);
  Grid spread = test::unsplit_grid({{-1024, 0, 0}, {1023, 0, 0}});
  for (int level = 0; level < kMaxGridLevel; ++level) {
    std::vector<char> marks(spread.num_cells(), 0);
    marks[0] = 1;
    spread = split_cells(spread, marks);
  }
  try {
    complete(spread, {}, {});
    FAIL() << "roots this far apart cannot be addressed at level 20";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::OutOfResources);
  }
}

TEST(Complete, CanBeCancelled) {
  const std::atomic<bool> cancel = true;
  Context context;
  context.cancel = &cancel;
  std::mt19937 rng(6);
  EXPECT_THROW(complete(random_grid(rng, {{0, 0, 0}}, 3), {}, context), Error);
}

}  // namespace
}  // namespace hexwright
