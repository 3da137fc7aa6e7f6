// Cells scaled by factors between halvings.
#include "hexwright/grid/rescale.h"

#include <random>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/grid/locate.h"

namespace hexwright {
namespace {

/// A random octree of the unit cube at an odd place.
Grid random_grid(unsigned seed, int depth) {
  std::mt19937 rng(seed);
  Grid grid = make_root_grid({{0.3, -2, 5}, 1.7});
  for (int d = 0; d < depth; ++d) {
    std::vector<char> marks(grid.num_cells());
    for (CellId c : grid.cells.ids()) marks[c.index()] = d == 0 || rng() % 3 == 0;
    grid = split_cells(grid, marks);
  }
  return grid;
}

double edge_of(const Grid& grid, CellId c) { return cell_box(grid, c).extent().x; }

TEST(RescaleGrid, EveryPlaceHasCellsOfTheWantedSizeOrSmaller) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (double factor : {0.51, 0.7, 0.9, 1.0}) {
    const Grid grid = random_grid(7, 5);
    const Grid scaled = rescale_grid(grid, factor);
    EXPECT_FALSE(scaled.find_problem());
    for (int k = 0; k < 2000; ++k) {
      const Vec3 p = grid.frame.origin + 1.7 * Vec3{unit(rng), unit(rng), unit(rng)};
      const CellId leaf = find_leaf_at(grid, p);
      const double before = edge_of(grid, leaf);
      // A leaf's outer quarter may be left to a larger cell.
      const Vec3 off = p - cell_box(grid, leaf).center();
      if (std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) > 0.25 * before) continue;
      EXPECT_LE(edge_of(scaled, find_leaf_at(scaled, p)), before * factor * (1 + 1e-12));
    }
  }
}

TEST(RescaleGrid, ACellIsSplitOnlyForAnOldLeafInIt) {
  const Grid grid = random_grid(11, 4);
  const double factor = 0.8;
  const Grid scaled = rescale_grid(grid, factor);
  for (CellId c : scaled.cells.ids()) {
    if (scaled.cells[c].level == 0) continue;
    // The parent holds an old leaf that wants cells smaller than the parent.
    const double edge = edge_of(scaled, c), root = scaled.frame.root_size;
    Box3 parent;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = cell_box(scaled, c).center()[axis] - scaled.frame.origin[axis];
      parent.lo[axis] = scaled.frame.origin[axis] + 2 * edge * std::floor(at / (2 * edge));
      parent.hi[axis] = parent.lo[axis] + 2 * edge;
    }
    EXPECT_LE(2 * edge, root * (1 + 1e-12));
    bool any = false;
    for (CellId old : grid.cells.ids()) {
      const Box3 box = cell_box(grid, old);
      bool overlaps = edge_of(grid, old) * factor < 2 * edge * (1 - 1e-9);
      for (int axis = 0; axis < 3; ++axis)
        overlaps = overlaps && box.lo[axis] < parent.hi[axis] && parent.lo[axis] < box.hi[axis];
      any = any || overlaps;
    }
    EXPECT_TRUE(any);
  }
}

TEST(RescaleGrid, ByOneChangesNothing) {
  const Grid grid = random_grid(5, 4);
  const Grid same = rescale_grid(grid, 1);
  EXPECT_EQ(same.cells, grid.cells);
  EXPECT_NEAR(distance(same.frame.origin, grid.frame.origin), 0, 1e-14);
}

TEST(RescaleGrid, AgainAndAgainKeepsTheRootSmall) {
  Grid grid = random_grid(9, 3);
  const double least = grid.frame.root_size, finest = least / 8;
  double product = 1;
  for (int k = 0; k < 5; ++k) {
    grid = rescale_grid(grid, 0.8, least);
    product *= 0.8;
    EXPECT_GE(grid.frame.root_size, least * (1 - 1e-9));
    EXPECT_LT(grid.frame.root_size, 2 * least);
    EXPECT_NEAR(grid.frame.root_size / (1 << grid.finest_level), finest * product, 1e-12);
  }
}

TEST(RescaleGrid, LeavesThatAreNotNeededAreForgotten) {
  const Grid grid = random_grid(5, 5);
  std::vector<char> is_needed(grid.num_cells(), 0);
  is_needed[grid.num_cells() / 2] = 1;
  const CellId kept(grid.num_cells() / 2);
  const Grid scaled = rescale_grid(grid, 0.8, 0, is_needed);
  EXPECT_FALSE(scaled.find_problem());
  EXPECT_LT(scaled.num_cells(), grid.num_cells() / 4);
  const Vec3 p = cell_box(grid, kept).center();
  EXPECT_NEAR(edge_of(scaled, find_leaf_at(scaled, p)), 0.8 * edge_of(grid, kept), 1e-12);
  EXPECT_EQ(rescale_grid(grid, 0.8, 0, std::vector<char>(grid.num_cells(), 0)).num_cells(), 1u);
}

TEST(RescaleGrid, RejectsFactorsThatAreNone) {
  const Grid grid = random_grid(1, 2);
  for (double factor : {0.0, 0.5, 1.01, -1.0}) EXPECT_THROW(rescale_grid(grid, factor), Error);
  EXPECT_THROW(rescale_grid(grid, 0.8, 0, std::vector<char>(3, 1)), Error);
  Grid two = grid;
  two.roots.push_back({1, 0, 0});
  EXPECT_THROW(rescale_grid(two, 0.8), Error);
}

}  // namespace
}  // namespace hexwright
