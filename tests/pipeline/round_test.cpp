// Which of two rounds of the loop is the better result.
#include <cmath>

#include <gtest/gtest.h>

#include "helpers.h"
#include "pipeline/loop/loop.h"

namespace hexwright {
namespace {

class RoundTest : public testing::Test {
 protected:
  /// Nothing is expected of the topology, unless a test says so.
  RoundTest() { target_.expected = {}; }
  /// A round as the loop sees it. Distances in tolerances.
  Round round(double distance, double quality, int num_hexes = 10) const {
    Round r;
    r.verdict.distance.emplace();
    r.verdict.distance->max_to_mesh = distance * options_.sizing.tolerance;
    r.verdict.quality.min_scaled_jacobian = quality;
    r.fit.mesh.hexes.resize(static_cast<std::size_t>(num_hexes));
    return r;
  }
  /// Better, and the other one is not better as well.
  void expect_better(const Round& a, const Round& b) const {
    const RoundInput input{target_, options_, plan_, context_};
    EXPECT_TRUE(is_better(input, a, b));
    EXPECT_FALSE(is_better(input, b, a));
  }

  Target target_ = wrap_target(test::unit_cube_surface());
  MeshOptions options_;
  StagePlan plan_;
  Context context_;
};

TEST_F(RoundTest, AMeshWithInvertedHexesIsTheWorst) {
  Round invalid = round(0.1, 0.9);
  invalid.verdict.failures.push_back("inverted");
  invalid.verdict.quality.num_inverted = 1;
  expect_better(round(50, 0.01), invalid);
}

TEST_F(RoundTest, BeyondTheGateAFarNearerRoundIsKept) {
  Round touching = round(0.2, 0.2);
  touching.verdict.failures.push_back("non-manifold");
  expect_better(touching, round(13.6, 0.2));
  expect_better(round(3, 0.2), touching);
}

TEST_F(RoundTest, TheGateGoesBeforeQuality) { expect_better(round(1.5, 0.17), round(7.5, 0.2)); }

TEST_F(RoundTest, TheToleranceGoesBeforeQuality) {
  expect_better(round(0.9, 0.1), round(1.1, 0.6));
}

TEST_F(RoundTest, WithinTheToleranceQualityThenSizeDecide) {
  expect_better(round(0.9, 0.3, 500), round(0.2, 0.1, 10));
  expect_better(round(0.9, 0.3, 10), round(0.2, 0.5, 11));
}

TEST_F(RoundTest, BeyondTheGateTheNearerOneWins) {
  expect_better(round(3, 0.5, 500), round(4, 0.5, 10));
}

TEST_F(RoundTest, WithinTheToleranceTheMeanComesLast) {
  Round coarse = round(0.9, 0.3, 10), fine = round(0.9, 0.3, 500), poor = round(0.9, 0.1, 10);
  coarse.verdict.distance->mean_to_mesh = 1.1 * mean_goal(options_);
  fine.verdict.distance->mean_to_surface = 0.9 * mean_goal(options_);
  expect_better(fine, coarse);
  expect_better(coarse, poor);
  Round finer = fine;
  finer.verdict.distance->mean_to_surface = 0.1 * mean_goal(options_);
  finer.fit.mesh.hexes.resize(600);
  expect_better(fine, finer);  // near enough: the smaller one
  options_.mean_share = 0;
  expect_better(coarse, fine);
}

TEST_F(RoundTest, AMeanAboveItsShareIsScaledAway) {
  const RoundInput input{target_, options_, plan_, context_};
  Round r = round(0.5, 0.3);
  EXPECT_TRUE(is_content(input, r));
  EXPECT_FALSE(scale_for_mean(input, r));
  r.verdict.distance->mean_to_mesh = 1.5 * mean_goal(options_);
  EXPECT_FALSE(is_content(input, r));
  const auto scale = scale_for_mean(input, r);
  ASSERT_TRUE(scale);
  EXPECT_LT(*scale, std::sqrt(1 / 1.5));
  EXPECT_GT(*scale, 0.9 * std::sqrt(1 / 1.5));
  // A mean of any size is approached in steps that a grid can make.
  r.verdict.distance->mean_to_mesh = 100 * mean_goal(options_);
  EXPECT_GT(*scale_for_mean(input, r), 0.5);
}

TEST_F(RoundTest, ScalingWaitsForWhatItDoesNotMend) {
  const RoundInput input{target_, options_, plan_, context_};
  Round slightly = round(1.2, 0.3), far = round(2, 0.3), poor = round(0.5, 0.1);
  for (Round* r : {&slightly, &far, &poor})
    r->verdict.distance->mean_to_mesh = 1.5 * mean_goal(options_);
  EXPECT_TRUE(scale_for_mean(input, slightly));  // 1.2 / 1.5 of the tolerance afterwards
  EXPECT_FALSE(scale_for_mean(input, far));
  EXPECT_FALSE(scale_for_mean(input, poor));
  // Far off in both: the grid is too coarse for some places, which are refined first.
  Round coarse = round(8, 0.3);
  coarse.verdict.distance->mean_to_mesh = 13 * mean_goal(options_);
  EXPECT_FALSE(scale_for_mean(input, coarse));
}

TEST_F(RoundTest, WithinTheGateTopologyGoesBeforeDistance) {
  target_.expected = {.is_known = true, .num_components = 1, .euler_characteristic = 2};
  Round sphere = round(1.9, 0.1), torus = round(0.1, 0.9);
  for (Round* r : {&sphere, &torus}) r->verdict.topology.num_boundary_components = 1;
  sphere.verdict.topology.boundary_euler_characteristic = 2;
  expect_better(sphere, torus);
  sphere.verdict.distance->max_to_mesh = 2.1 * options_.sizing.tolerance;
  expect_better(torus, sphere);
}

// What users are not told of, the mean alone, may be given up for a better shape.
TEST_F(RoundTest, WhatIsMetStaysMet) {
  const RoundInput input{target_, options_, plan_, context_};
  const Round before = round(0.9, 0.3);
  EXPECT_TRUE(meets_no_less(input, before, before));
  EXPECT_TRUE(meets_no_less(input, round(1.2, 0.3), before));
  EXPECT_FALSE(meets_no_less(input, before, round(1.2, 0.3)));
  EXPECT_FALSE(meets_no_less(input, before, round(0.9, 0.1)));
  Round rough = before, broken = before;
  rough.verdict.distance->mean_to_mesh = 2 * mean_goal(options_);
  EXPECT_TRUE(meets_no_less(input, before, rough));
  broken.verdict.failures.push_back("a vertex lies inside an edge of another hex");
  EXPECT_FALSE(meets_no_less(input, before, broken));
  EXPECT_TRUE(meets_no_less(input, broken, broken));
}

TEST_F(RoundTest, OnlyWithinTheGateIsGrowthOutOfProportion) {
  plan_.budgets.growth = 2.5;
  const RoundInput input{target_, options_, plan_, context_};
  Round near = round(1.5, 0.3), far = round(2.5, 0.3);
  for (Round* r : {&near, &far}) r->grid.cells.resize(100);
  EXPECT_FALSE(is_out_of_proportion(input, near, 250));
  EXPECT_TRUE(is_out_of_proportion(input, near, 251));
  EXPECT_FALSE(is_out_of_proportion(input, far, 100'000));
}

TEST_F(RoundTest, ThinPlacesAreRefinedOnlyForTopologyAndWhenNothingElseIs) {
  target_.expected = {.is_known = true, .num_components = 1, .euler_characteristic = 2};
  const RoundInput input{target_, options_, plan_, context_};
  Round torus = round(0.5, 0.5);
  torus.grid = make_grid({{0, 0, 0}, 2}, {{0, 0, 0}, {1, 0, 0}}, {{0, {0, 0, 0}}, {0, {1, 0, 0}}});
  torus.verdict.topology.num_boundary_components = 1;
  torus.fit.report.carve.thin = {{1, 1, 1}};
  EXPECT_EQ(mark_misses(input, torus), (std::vector<char>{1, 0}));
  torus.fit.report.carve.lost = {{3, 1, 1}};
  EXPECT_EQ(mark_misses(input, torus), (std::vector<char>{0, 1}));
  torus.fit.report.carve.lost.clear();
  torus.verdict.topology.boundary_euler_characteristic = 2;
  EXPECT_EQ(mark_misses(input, torus), (std::vector<char>{0, 0}));
  // The tip of a wedge is lost on any grid: with the right topology only its distance counts.
  torus.fit.report.carve.lost = {{3, 1, 1}};
  EXPECT_EQ(mark_misses(input, torus), (std::vector<char>{0, 0}));
  torus.verdict.distance->hot = {{1, 1, 1}};
  EXPECT_EQ(mark_misses(input, torus), (std::vector<char>{1, 0}));
  target_.expected.is_known = false;
  torus.verdict.distance->hot.clear();
  EXPECT_EQ(mark_misses(input, torus), (std::vector<char>{0, 1}));
}

TEST_F(RoundTest, RefinesWhereTheBoundaryTouchesItself) {
  const RoundInput input{target_, options_, plan_, context_};
  Round r = round(0.5, 0.5);
  r.grid = make_grid({{0, 0, 0}, 2}, {{0, 0, 0}, {1, 0, 0}}, {{0, {0, 0, 0}}, {0, {1, 0, 0}}});
  r.fit.mesh.positions = IdVector<VertId, Vec3>({{1, 1, 1}, {3, 1, 1}});
  r.verdict.topology.hanging_verts = {VertId(1)};
  EXPECT_EQ(mark_misses(input, r), (std::vector<char>{0, 1}));
}

}  // namespace
}  // namespace hexwright
