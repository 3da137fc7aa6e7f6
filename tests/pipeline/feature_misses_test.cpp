// Which missed places on features the loop refines for.
#include "pipeline/loop/feature_misses.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace hexwright {
namespace {

/// The unit cube in 4 x 4 x 4 cells, but its first octant in cells half as large.
Grid two_level_grid() {
  Grid grid = make_root_grid({{0, 0, 0}, 1});
  for (int level = 0; level < 2; ++level)
    grid = split_cells(grid, std::vector<char>(grid.num_cells(), 1));
  std::vector<char> is_marked(grid.num_cells(), 0);
  for (CellId c : grid.cells.ids()) {
    const Box3 box = cell_box(grid, c);
    is_marked[c.index()] = box.hi.x <= 0.5 && box.hi.y <= 0.5 && box.hi.z <= 0.5 ? 1 : 0;
  }
  return split_cells(grid, is_marked);
}

constexpr double kFine = 0.125, kCoarse = 0.25;  // cell sizes of that grid
constexpr double kTolerance = 0.001;
const Vec3 kInFine = {0.3, 0.3, 0.3}, kInCoarse = {0.7, 0.7, 0.7};

FeatureRecovery one_curve(double length, double share) {
  FeatureRecovery features;
  features.total_length = length;
  features.length_share = share;
  features.curves.push_back({length, 0, share});
  features.missed = {{kInFine, CurveId(0), 0}, {kInCoarse, CurveId(0), 0}};
  return features;
}

TEST(FeatureMisses, ACurveWithoutAPathGetsCellsShortEnoughForOne) {
  const Grid grid = two_level_grid();
  const auto refinable = [&](double cells_along, double size) {
    return find_refinable_features(grid, one_curve(cells_along * size, 0.1), kTolerance, 9);
  };
  EXPECT_EQ(refinable(kCellsPerCurve * 0.99, kFine), (std::vector<Vec3>{kInFine, kInCoarse}));
  EXPECT_EQ(refinable(kCellsPerCurve, kFine), std::vector<Vec3>{kInCoarse});
  EXPECT_EQ(refinable(kCellsPerCurve, kCoarse), std::vector<Vec3>{});
}

TEST(FeatureMisses, EdgesOfSufficientCellsBowLessThanTheTolerance) {
  const double radius = 0.3, turn = 2 * std::numbers::pi;
  for (double tolerance : {0.01, 0.001, 0.0001}) {
    const double cell = sufficient_cell_size({turn * radius, turn, 0}, tolerance);
    EXPECT_LE(radius - std::sqrt(radius * radius - cell * cell / 4), 1.02 * tolerance);
    EXPECT_LE(cell * kCellsPerCurve, turn * radius);
  }
  EXPECT_EQ(sufficient_cell_size({2, 0, 0}, 1e-9), 2 / kCellsPerCurve);  // straight
}

TEST(FeatureMisses, ACurveThatIsFollowedMayBeRefinedFurther) {
  const Grid grid = two_level_grid();
  EXPECT_EQ(find_refinable_features(grid, one_curve(100, kFollowedShare), kTolerance, 9).size(),
            2u);
  EXPECT_EQ(find_refinable_features(grid, one_curve(100, kFollowedShare), kTolerance, 3),
            std::vector<Vec3>{kInCoarse});
  EXPECT_EQ(find_refinable_features(grid, one_curve(100, kFollowedShare), kTolerance, 2),
            std::vector<Vec3>{});
}

TEST(FeatureMisses, NoCurveAsksForCellsFarBelowTheTolerance) {
  const double tolerance = 0.001;
  EXPECT_EQ(sufficient_cell_size({0.002, 0, 0}, tolerance), kLeastFeatureCell * tolerance);
}

TEST(FeatureMisses, CornersAndPlacesOutsideTheGrid) {
  const Grid grid = two_level_grid();
  FeatureRecovery features;
  features.missed = {{kInFine, {}, 0.01}, {{2, 0, 0}, {}, 0.01}};
  EXPECT_EQ(find_refinable_features(grid, features, kTolerance, 9), std::vector<Vec3>{kInFine});
  EXPECT_TRUE(find_refinable_features(grid, {}, kTolerance, 9).empty());
}

}  // namespace
}  // namespace hexwright
