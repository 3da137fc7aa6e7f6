// Bounds of cells' sizes, growth, and lattices of given edges.
#include "hexwright/grid/size_field.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "hexwright/base/cancel.h"
#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/grid/locate.h"

#include "helpers.h"
#include "solids.h"

namespace hexwright {
namespace {

constexpr std::size_t kEnough = 1'000'000;

constexpr auto everywhere = [](const Box3&) { return true; };

SizeField::Limit bound_at(const Vec3& p, double size) {
  return [p, size](const Box3& cell) {
    return cell.contains(p) ? size : std::numeric_limits<double>::infinity();
  };
}

double edge_at(const Grid& grid, const Vec3& p) {
  return cell_box(grid, find_leaf_at(grid, p)).extent().x;
}

/// Distance between two boxes along the axis where they are farthest apart.
double gap(const Box3& a, const Box3& b) {
  double most = 0;
  for (int axis = 0; axis < 3; ++axis)
    most = std::max({most, a.lo[axis] - b.hi[axis], b.lo[axis] - a.hi[axis]});
  return most;
}

TEST(SizeField, CellsAreTheLargestWithinTheBound) {
  SizeField field;
  field.limits.push_back([](const Box3&) { return 0.3; });
  field.limits.push_back(bound_at({0.1, 0.1, 0.1}, 0.1));
  const Grid grid = refine_to_sizes(make_root_grid({{0, 0, 0}, 1}), field, everywhere, kEnough);
  EXPECT_FALSE(grid.find_problem());
  EXPECT_DOUBLE_EQ(edge_at(grid, {0.1, 0.1, 0.1}), 1.0 / 16);
  EXPECT_DOUBLE_EQ(edge_at(grid, {0.9, 0.1, 0.1}), 0.25);
}

TEST(SizeField, NoCellIsBelowTheDeepestLevel) {
  SizeField field;
  field.limits.push_back(bound_at({0.1, 0.1, 0.1}, 0.01));
  field.deepest = 3;
  const Grid grid = refine_to_sizes(make_root_grid({{0, 0, 0}, 1}), field, everywhere, kEnough);
  EXPECT_EQ(grid.finest_level, 3);
}

TEST(SizeField, BoundsAreAskedOncePerCell) {
  SizeField field;
  std::atomic<std::size_t> num_calls = 0;
  field.limits.push_back([&](const Box3& cell) {
    ++num_calls;
    return cell.contains({0.1, 0.1, 0.1}) ? 0.01 : 1.0;
  });
  const Grid grid = refine_to_sizes(make_root_grid({{0, 0, 0}, 1}), field, everywhere, kEnough);
  EXPECT_EQ(num_calls, 1 + 8 * ((grid.num_cells() - 1) / 7));
}

TEST(SizeField, EndsWhereTheCallerWantsIt) {
  SizeField field;
  field.limits.push_back([](const Box3&) { return 0.1; });
  const std::atomic<bool> is_cancelled = true;
  const CancelScope scope(&is_cancelled);
  EXPECT_THROW(refine_to_sizes(make_root_grid({{0, 0, 0}, 1}), field, everywhere, kEnough), Error);
}

TEST(SizeField, TheLeastEdgeAndPlacesThatDoNotMatterStayCoarse) {
  SizeField field;
  field.limits.push_back([](const Box3&) { return 0.01; });
  field.least_edge = 0.25;
  const auto left_half = [](const Box3& cell) { return cell.lo.x < 0.5; };
  const Grid grid = refine_to_sizes(make_root_grid({{0, 0, 0}, 1}), field, left_half, kEnough);
  EXPECT_DOUBLE_EQ(edge_at(grid, {0.1, 0.1, 0.1}), 0.25);
  EXPECT_DOUBLE_EQ(edge_at(grid, {0.9, 0.1, 0.1}), 0.5);
}

TEST(SizeField, AnExactFieldAllowsOneLevelMore) {
  SizeField field;
  field.limits.push_back([](const Box3&) { return 0.25; });
  field.is_exact = true;
  Grid grid = refine_to_sizes(make_root_grid({{0, 0, 0}, 1}), field, everywhere, kEnough);
  EXPECT_TRUE(may_split(grid, CellId(0), field));
  std::vector<char> marks(grid.num_cells(), 0);
  marks[0] = 1;
  grid = split_cells(grid, marks);
  EXPECT_FALSE(may_split(grid, CellId(0), field));
}

TEST(SizeField, ABudgetIsAnErrorAndNoCoarserGrid) {
  SizeField field;
  field.limits.push_back([](const Box3&) { return 0.01; });
  EXPECT_THROW(refine_to_sizes(make_root_grid({{0, 0, 0}, 1}), field, everywhere, 1000), Error);
}

TEST(SizeField, CellsGrowWithTheDistanceFromSmallOnes) {
  for (double growth : {1.2, 1.5, 2.0}) {
    SizeField field;
    field.limits.push_back(bound_at({0.51, 0.51, 0.51}, 1.0 / 32));
    field.growth = growth;
    const Grid grid = refine_to_sizes(make_root_grid({{0, 0, 0}, 1}), field, everywhere, kEnough);
    EXPECT_FALSE(grid.find_problem());
    const Box3 source = cell_box(grid, find_leaf_at(grid, {0.51, 0.51, 0.51}));
    const double h = source.extent().x;
    EXPECT_DOUBLE_EQ(h, 1.0 / 32);
    for (CellId c : grid.cells.ids()) {
      const Box3 box = cell_box(grid, c);
      EXPECT_GE(gap(source, box), (box.extent().x - h) / (growth - 1) * (1 - 1e-9)) << growth;
    }
  }
}

TEST(SizeField, GridsDoNotDependOnThreads) {
  SizeField field;
  field.limits.push_back(bound_at({0.3, 0.4, 0.5}, 1.0 / 32));
  field.growth = 1.3;
  const auto build = [&] {
    return refine_to_sizes(make_root_grid({{0, 0, 0}, 1}), field, everywhere, kEnough).cells;
  };
  decltype(build()) one;
  {
    const ThreadLimit limit(1);
    one = build();
  }
  EXPECT_EQ(build().raw(), one.raw());
}

/// How far a plane is from the nearest one between hexes, in cells.
double off_lattice(const SizedDomain& sized, int axis, double at) {
  const GridFrame& f = sized.domain.frame;
  const double h = f.root_edge(axis) / (1 << sized.level);
  const double x = (at - f.origin[axis]) / h - 0.5;
  return std::abs(x - std::round(x));
}

TEST(Lattice, HasTheEdgeExactlyAndHoldsTheObject) {
  for (double edge : {0.07, 0.1, 0.31}) {
    const SizedDomain sized = fit_lattice(test::unit_sphere_surface(3), edge, 0.02);
    const GridFrame& f = sized.domain.frame;
    EXPECT_DOUBLE_EQ(f.root_size, edge * (1 << sized.level));
    EXPECT_EQ(f.stretch, (Vec3{1, 1, 1}));
    for (int a = 0; a < 3; ++a) {
      EXPECT_LE(f.origin[a], -1.02);
      EXPECT_GE(f.origin[a] + f.root_edge(a), 1.02);
    }
  }
}

TEST(Lattice, PutsPlanesBetweenHexesAndShortensCellsForThat) {
  const TriMesh brick = test::box_surface({1, 2, 3}, {11.3, 9.1, 6.3});
  const SizedDomain sized = fit_lattice(brick, 1, 0.02);
  const double ends[3][2] = {{1, 11.3}, {2, 9.1}, {3, 6.3}};
  const double counts[3] = {11, 8, 4};
  for (int a = 0; a < 3; ++a) {
    for (double end : ends[a]) EXPECT_NEAR(off_lattice(sized, a, end), 0, 1e-9);
    const double h = sized.domain.frame.root_edge(a) / (1 << sized.level);
    EXPECT_NEAR((ends[a][1] - ends[a][0]) / h, counts[a], 1e-9);
    EXPECT_LE(h, 1 + 1e-12);
  }
}

TEST(Lattice, RootsAreNeverTooLargeForTheLeastSide) {
  const SizedDomain sized = fill_box({{0, 0, 0}, {20, 2, 2}}, 10, 4);
  EXPECT_LE(sized.domain.frame.root_size, 0.5);
  for (int a = 0; a < 3; ++a) EXPECT_GE(sized.domain.frame.stretch[a], 0.75);
}

TEST(Lattice, FillsABoxOfAnyProportionsExactly) {
  const Box3 box{{-5, 0, 1}, {20, 10, 8.5}};
  const SizedDomain sized = fill_box(box, 0.3, 4);
  const GridFrame& f = sized.domain.frame;
  EXPECT_DOUBLE_EQ(f.root_size, 0.3 * (1 << sized.level));
  Box3 filled;
  for (const LatticeCoord& root : sized.domain.roots)
    for (int end : {0, 1})
      filled.extend(Vec3{f.origin.x + (root[0] + end) * f.root_edge(0),
                         f.origin.y + (root[1] + end) * f.root_edge(1),
                         f.origin.z + (root[2] + end) * f.root_edge(2)});
  EXPECT_NEAR(distance(filled.lo, box.lo), 0, 1e-12);
  EXPECT_NEAR(distance(filled.hi, box.hi), 0, 1e-12);
  for (int a = 0; a < 3; ++a) EXPECT_GE(f.stretch[a], 0.75);
  EXPECT_FALSE(refine_to_sizes(make_grid(f, sized.domain.roots,
                                         [&] {
                                           std::vector<CellSpec> cells;
                                           for (const LatticeCoord& r : sized.domain.roots)
                                             cells.push_back({0, r});
                                           return cells;
                                         }()),
                               {}, everywhere, kEnough)
                   .find_problem());
}

TEST(Lattice, RefusesWhatHasNoRoom) {
  EXPECT_THROW(fit_lattice(test::unit_cube_surface(), 0, 0.02), Error);
  EXPECT_THROW(fit_lattice(test::unit_cube_surface(), 1e-9, 0.02), Error);
  EXPECT_THROW(fill_box({{0, 0, 0}, {1, 1, 0}}, 1, 4), Error);
  EXPECT_THROW(fill_box({{0, 0, 0}, {1e6, 1, 1}}, 1, 4), Error);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(fill_box({{0, 0, 0}, {1, 1, 1}}, infinity, 4), Error);
  EXPECT_THROW(fill_box({{0, 0, 0}, {infinity, infinity, infinity}}, 1, 4), Error);
}

}  // namespace
}  // namespace hexwright
