// Grids from a size function, against splitting round by round.
#include "hexwright/grid/refine.h"

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"

#include "grid/grid_helpers.h"

namespace hexwright {
namespace {

/// Finer towards a point: a cell is split while it is larger than half its distance.
const auto is_too_large = [](const Box3& box, int) {
  return box.extent().x > 0.05 + 0.5 * distance(box.center(), {0.3, 0.4, 0.9});
};

Grid refined_slowly(const GridFrame& frame, const test::Roots& roots, int max_level) {
  Grid grid = test::unsplit_grid(roots);
  grid.frame = frame;
  for (int level = 0; level < max_level; ++level) {
    std::vector<char> marks;
    for (const CellId c : grid.cells.ids())
      marks.push_back(grid.cells[c].level == level && is_too_large(cell_box(grid, c), level));
    grid = split_cells(grid, marks);
  }
  return grid;
}

TEST(RefineWhere, EqualsSplittingRoundByRound) {
  const GridFrame frame{{-0.5, 0.25, 0}, 1.5};
  for (const test::Roots& unsorted : test::sample_domains())
    for (const int max_level : {0, 1, 3, 5}) {
      const test::Roots roots = test::unsplit_grid(unsorted).roots;
      const Grid grid = refine_where(frame, roots, max_level, is_too_large);
      const Grid expected = refined_slowly(frame, roots, max_level);
      EXPECT_EQ(grid.cells, expected.cells);
      EXPECT_EQ(grid.finest_level, expected.finest_level);
      EXPECT_EQ(grid.roots, expected.roots);
      EXPECT_EQ(grid.frame, frame);
    }
}

TEST(RefineWhere, IsTheSameForEveryThreadCountAndAsksOncePerCell) {
  const auto build = [](int threads) {
    const ThreadLimit limit(threads);
    return refine_where({{0, 0, 0}, 1}, {{0, 0, 0}}, 6, is_too_large);
  };
  const Grid one = build(1);
  EXPECT_GT(one.num_cells(), 200u);
  EXPECT_EQ(build(2).cells, one.cells);
  const ThreadLimit limit(1);
  std::size_t num_calls = 0;
  const auto counted = [&](const Box3& box, int level) {
    ++num_calls;
    return is_too_large(box, level);
  };
  const Grid again = refine_where({{0, 0, 0}, 1}, {{0, 0, 0}}, 6, counted);
  // Every cell and every split node, but not the cells that may not be split any more.
  const std::size_t num_nodes = again.num_cells() + (again.num_cells() - 1) / 7;
  EXPECT_LE(num_calls, num_nodes);
}

TEST(RefineWhere, RejectsLevelsAndRootsOutOfRange) {
  EXPECT_THROW(refine_where({}, {{0, 0, 0}}, -1, is_too_large), Error);
  EXPECT_THROW(refine_where({}, {{0, 0, 0}}, kMaxGridLevel + 1, is_too_large), Error);
  EXPECT_THROW(refine_where({}, {}, 2, is_too_large), Error);
  EXPECT_THROW(refine_where({}, {{1, 0, 0}, {0, 0, 0}}, 0, is_too_large), Error);
  EXPECT_THROW(refine_where({}, {{5000, 0, 0}}, 0, is_too_large), Error);
}

}  // namespace
}  // namespace hexwright
