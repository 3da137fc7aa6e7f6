// Evening out levels: never coarser, never dearer, and thin parts get cells of one size.
#include "hexwright/grid/even_levels.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "hexwright/base/parallel.h"
#include "hexwright/grid/locate.h"
#include "hexwright/grid/sizing.h"

#include "helpers.h"

namespace hexwright {
namespace {

/// The box [0,a] x [0,b] x [0,c].
TriMesh box_surface(const Vec3& size) {
  TriMesh s = test::unit_cube_surface();
  for (Vec3& p : s.positions) p = {size.x * p.x, size.y * p.y, size.z * p.z};
  return s;
}

/// The root cube around the surface, with leaves at the surface split to `level`, and to
/// `deep_level` near the point.
Grid graded_grid(const SurfaceTree& tree, int level, int deep_level, const Vec3& deep_point) {
  Grid grid = make_root_grid(root_frame(tree.box(), 0.02));
  for (int l = 0; l < deep_level; ++l) {
    std::vector<char> marks(grid.num_cells(), 0);
    for (CellId c : grid.cells.ids()) {
      const Box3 box = cell_box(grid, c);
      const double reach = 0.5 * box.diagonal();
      marks[c.index()] = l < level ? tree.distance(box.center()) < reach
                                   : distance(box.center(), deep_point) < reach;
    }
    grid = split_cells(grid, marks);
  }
  return grid;
}

/// By brute force: leaves whose cube may meet the solid, those beside another level counted
/// 1 + transition_cost times.
double price(const Grid& grid, const SurfaceTree& tree, double transition_cost) {
  double total = 0;
  for (CellId c : grid.cells.ids()) {
    const Box3 a = cell_box(grid, c);
    if (!tree.is_inside(a.center()) && tree.distance(a.center()) > 0.5 * a.diagonal()) continue;
    const double slack = 1e-9 * grid.frame.root_size;
    bool meets_other_level = false;
    for (CellId d : grid.cells.ids()) {
      if (grid.cells[d].level == grid.cells[c].level) continue;
      const Box3 b = cell_box(grid, d);
      int num_overlapping = 0, num_touching = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double overlap = std::min(a.hi[axis], b.hi[axis]) - std::max(a.lo[axis], b.lo[axis]);
        num_overlapping += overlap > slack;
        num_touching += std::abs(overlap) <= slack;
      }
      meets_other_level |= num_overlapping == 2 && num_touching == 1;
    }
    total += 1 + (meets_other_level ? transition_cost : 0);
  }
  return total;
}

bool is_refinement_of(const Grid& fine, const Grid& coarse) {
  for (CellId c : fine.cells.ids()) {
    const CellId holder = find_leaf_at(coarse, cell_box(fine, c).center());
    if (!holder.is_valid() || coarse.cells[holder].level > fine.cells[c].level) return false;
  }
  return true;
}

TEST(EvenLevels, WithoutTransitionCostOnlyCompletes) {
  const SurfaceTree tree(test::unit_sphere_surface(3));
  const Grid grid = graded_grid(tree, 3, 5, {0, 0, 1});
  const EvenedGrid evened = even_levels(grid, occupancy_of(tree), {}, {.transition_cost = 0}, {});
  EXPECT_EQ(evened.base_level, 0);
  EXPECT_EQ(evened.completed.grid.cells, complete(grid, {}, {}).grid.cells);
}

TEST(EvenLevels, ResultIsACompletedRefinement) {
  const SurfaceTree tree(test::unit_sphere_surface(3));
  const Grid grid = graded_grid(tree, 3, 4, {0, 0, 1});
  for (const double cost : {0.5, 2.0, 8.0}) {
    const EvenedGrid evened =
        even_levels(grid, occupancy_of(tree), {}, {.transition_cost = cost}, {});
    const Grid& result = evened.completed.grid;
    EXPECT_FALSE(result.find_problem());
    EXPECT_FALSE(find_unbalanced(result, Balance::Weak));
    EXPECT_FALSE(find_unpaired(result));
    EXPECT_TRUE(is_refinement_of(result, grid));
  }
}

TEST(EvenLevels, IsPricedAsByBruteForceAndNeverDearerThanBefore) {
  const SurfaceTree tree(box_surface({1, 0.6, 0.4}));
  const Grid grid = graded_grid(tree, 3, 4, {1, 0.6, 0.4});
  const double plain = price(complete(grid, {}, {}).grid, tree, 2);
  const EvenedGrid evened = even_levels(grid, occupancy_of(tree), {}, {.transition_cost = 2}, {});
  EXPECT_DOUBLE_EQ(evened.cost, price(evened.completed.grid, tree, 2));
  EXPECT_LE(evened.cost, plain);
}

TEST(EvenLevels, ThinPartsGetCellsOfOneSizeAndThickOnesKeepTheirCoarseCells) {
  // A plate two cells thick, fine over most of it: evening the rest is cheap.
  const SurfaceTree plate(box_surface({1, 1, 0.1}));
  Grid grid = graded_grid(plate, 4, 5, {0.5, 0.5, 0.05});
  EvenedGrid evened = even_levels(grid, occupancy_of(plate), {}, {.transition_cost = 50}, {});
  EXPECT_EQ(evened.base_level, 5);
  // A cube with one fine corner.
  const SurfaceTree cube(test::unit_cube_surface());
  grid = graded_grid(cube, 2, 7, {1, 1, 1});
  evened = even_levels(grid, occupancy_of(cube), {}, {.transition_cost = 4}, {});
  EXPECT_LT(evened.base_level, 6);
  EXPECT_GE(evened.completed.grid.finest_level, 7);
}

// The object need not be a surface: two questions will do.
TEST(EvenLevels, AsksForNoMoreThanWhatTheObjectFills) {
  const Box3 box{{0, 0, 0}, {1, 1, 0.1}};
  const SurfaceTree plate(box_surface({1, 1, 0.1}));
  const Grid grid = graded_grid(plate, 4, 5, {0.5, 0.5, 0.05});
  Occupancy object;
  object.is_inside = [&](const Vec3& p) { return box.contains(p); };
  object.meets_surface = [&](const Box3& cell) {
    return plate.distance(cell.center()) <= 0.5 * cell.diagonal();
  };
  for (bool has_two_sides : {true, false}) {
    object.has_two_sides = has_two_sides;
    const EvenedGrid asked = even_levels(grid, object, {}, {.transition_cost = 50}, {});
    const EvenedGrid given =
        even_levels(grid, occupancy_of(plate), {}, {.transition_cost = 50}, {});
    EXPECT_EQ(asked.completed.grid.cells, given.completed.grid.cells);
    EXPECT_EQ(asked.cost, given.cost);
  }
}

TEST(EvenLevels, KeepsToTheBudget) {
  const SurfaceTree plate(box_surface({1, 1, 0.1}));
  const Grid grid = graded_grid(plate, 4, 5, {0.5, 0.5, 0.05});
  const std::size_t plain = complete(grid, {}, {}).grid.num_cells();
  const EvenOptions tight{.transition_cost = 50, .max_cells = plain};
  EXPECT_LE(even_levels(grid, occupancy_of(plate), {}, tight, {}).completed.grid.num_cells(),
            plain);
}

TEST(EvenLevels, DoesNotGrowObjectsBeyondTheirShare) {
  const SurfaceTree plate(box_surface({1, 1, 0.1}));
  const Grid grid = graded_grid(plate, 4, 5, {0.5, 0.5, 0.05});
  const EvenedGrid free = even_levels(grid, occupancy_of(plate), {}, {.transition_cost = 50}, {});
  ASSERT_EQ(free.base_level, 5);
  // About 32 x 32 x 4 cells at that level meet the plate or lie in it.
  const EvenedGrid roomy = even_levels(grid, occupancy_of(plate), {},
                                       {.transition_cost = 50, .max_object_cells = 8000}, {});
  EXPECT_EQ(roomy.completed.grid.cells, free.completed.grid.cells);
  const EvenedGrid tight = even_levels(grid, occupancy_of(plate), {},
                                       {.transition_cost = 50, .max_object_cells = 1000}, {});
  EXPECT_EQ(tight.base_level, 0);
}

TEST(EvenLevels, SameForAnyNumberOfThreads) {
  const SurfaceTree tree(test::unit_sphere_surface(3));
  const Grid grid = graded_grid(tree, 4, 5, {0, 1, 0});
  std::vector<EvenedGrid> results;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    results.push_back(even_levels(grid, occupancy_of(tree), {}, {}, {}));
  }
  for (const EvenedGrid& r : results) {
    EXPECT_EQ(r.completed.grid.cells, results[0].completed.grid.cells);
    EXPECT_EQ(r.cost, results[0].cost);
  }
}

}  // namespace
}  // namespace hexwright
