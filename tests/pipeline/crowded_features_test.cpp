// Where curves crowd, and how far the grid is split there.
#include "pipeline/loop/crowded_features.h"

#include <cmath>

#include <gtest/gtest.h>

#include "hexwright/grid/locate.h"

namespace hexwright {
namespace {

/// Straight curves between points; those with equal ends share a corner.
class Wires {
 public:
  void add(const Vec3& a, const Vec3& b) {
    FeatureCurve curve;
    curve.verts = {vert_at(a), vert_at(b)};
    curve.arc_length = {0, distance(a, b)};
    features_.curves.push_back(curve);
    recovery_.curves.push_back({curve.length(), 0, 0.0});
  }
  void miss(int curve, const Vec3& p) { recovery_.missed.push_back({p, CurveId(curve), 0}); }
  void follow(int curve) { recovery_.curves[CurveId(curve)].length_share = 0.9; }
  std::vector<SizedPlace> find(const Grid& grid, double least = 0.01) const {
    return find_crowded_misses(grid, surface_, features_, recovery_, least);
  }

 private:
  VertId vert_at(const Vec3& p) {
    for (VertId v : surface_.positions.ids())
      if (surface_.positions[v] == p) return v;
    return surface_.positions.push_back(p);
  }

  TriMesh surface_;
  FeatureGraph features_;
  FeatureRecovery recovery_;
};

/// The unit cube in cells of an eighth.
Grid uniform_grid() {
  Grid grid = make_root_grid({{0, 0, 0}, 1});
  for (int level = 0; level < 3; ++level)
    grid = split_cells(grid, std::vector<char>(grid.num_cells(), 1));
  return grid;
}

TEST(CrowdedFeatures, AskForCellsOfTheGapBetweenCurves) {
  const Grid grid = uniform_grid();
  for (double gap : {0.3, 0.13, 0.032, 0.03, 0.02, 0.002}) {
    Wires wires;
    wires.add({0.1, 0.5, 0.5}, {0.9, 0.5, 0.5});
    wires.add({0.1, 0.5 + gap, 0.5}, {0.9, 0.5 + gap, 0.5});
    wires.miss(0, {0.503, 0.5, 0.5});
    const auto places = wires.find(grid);
    if (gap > 0.03125) {
      EXPECT_TRUE(places.empty());
      continue;
    }
    ASSERT_EQ(places.size(), 1u) << gap;
    EXPECT_GE(places[0].cell_size, std::max(gap, 0.01));
    EXPECT_LE(places[0].cell_size, std::hypot(std::max(gap, 0.01), 0.005));  // sampled
    wires.follow(0);
    EXPECT_TRUE(wires.find(grid).empty());
  }
}

// Near the corner where they meet all curves are close to each other; only narrow angles crowd.
TEST(CrowdedFeatures, MayMeetAtACorner) {
  const Grid grid = uniform_grid();
  for (double degrees : {5.0, 10.0, 30.0, 90.0}) {
    const double angle = degrees * 3.14159265358979 / 180;
    Wires wires;
    wires.add({0.1, 0.1, 0.5}, {0.9, 0.1, 0.5});
    wires.add({0.1, 0.1, 0.5}, {0.1 + 0.8 * std::cos(angle), 0.1 + 0.8 * std::sin(angle), 0.5});
    wires.miss(0, {0.3, 0.1, 0.5});
    EXPECT_EQ(wires.find(grid).size(), degrees < 8 ? 1u : 0u) << degrees;
  }
}

TEST(CrowdedFeatures, LeavesAreSplitToTheSizeAskedAndNoFurther) {
  const Grid grid = uniform_grid();
  const std::vector<SizedPlace> places = {
      {{0.3, 0.3, 0.3}, 0.02}, {{0.7, 0.7, 0.7}, 0.06}, {{0.1, 0.9, 0.1}, 0.2}, {{5, 0, 0}, 0.01}};
  const Grid fine = split_to_sizes(grid, places, 9);
  const auto level_at = [](const Grid& g, const Vec3& p) {
    return int{g.cells[find_leaf_at(g, p)].level};
  };
  EXPECT_EQ(level_at(fine, places[0].position), 6);  // 1/64 < 0.02 < 1/32
  EXPECT_EQ(level_at(fine, places[1].position), 5);
  EXPECT_EQ(level_at(fine, places[2].position), 3);
  EXPECT_EQ(fine.num_cells(), grid.num_cells() + 7 * (3 + 2));
  EXPECT_EQ(level_at(split_to_sizes(grid, places, 4), places[0].position), 4);
}

}  // namespace
}  // namespace hexwright
