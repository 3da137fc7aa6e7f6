// Clipping to a cube, against areas sampled by brute force.
#include "grid/sizing/box_clip.h"

#include <random>

#include <gtest/gtest.h>

namespace hexwright {

using namespace grids;

namespace {

double polygon_area(const ClippedPolygon& p) {
  Vec3 sum;
  for (int k = 1; k + 1 < p.count; ++k)
    sum += cross(p.points[static_cast<std::size_t>(k)] - p.points[0],
                 p.points[static_cast<std::size_t>(k + 1)] - p.points[0]);
  return norm(sum) / 2;
}

std::array<Vec3, 3> random_triangle(std::mt19937& rng, double size) {
  std::uniform_real_distribution<double> u(-size, size);
  std::array<Vec3, 3> t;
  for (Vec3& p : t) p = {u(rng), u(rng), u(rng)};
  return t;
}

/// Share of a triangle inside the cube, from a fine barycentric raster.
double sampled_share(const std::array<Vec3, 3>& t, double half) {
  constexpr int kSteps = 200;
  int inside = 0, total = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; i + j < kSteps; ++j) {
      const double u = (i + 1.0 / 3) / kSteps, v = (j + 1.0 / 3) / kSteps;
      ++total;
      inside += in_cube(t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v, half);
    }
  return static_cast<double>(inside) / total;
}

TEST(BoxClip, KeepsTheAreaInsideTheCube) {
  std::mt19937 rng(7);
  for (int trial = 0; trial < 60; ++trial) {
    const auto t = random_triangle(rng, 1.2);
    const ClippedPolygon p = clip_to_cube(t, 0.5);
    const double area = norm(cross(t[1] - t[0], t[2] - t[0])) / 2;
    EXPECT_NEAR(polygon_area(p) / area, sampled_share(t, 0.5), 0.02) << "trial " << trial;
    for (int k = 0; k < p.count; ++k)
      EXPECT_TRUE(in_cube(p.points[static_cast<std::size_t>(k)], 0.5 + 1e-12));
  }
}

TEST(BoxClip, LeavesATriangleInsideUntouched) {
  const std::array<Vec3, 3> t = {{{0.1, 0.2, 0.3}, {-0.1, 0, 0}, {0.5, -0.5, 0.5}}};
  const ClippedPolygon p = clip_to_cube(t, 0.5);
  ASSERT_EQ(p.count, 3);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(p.points[k], t[k]);
}

TEST(BoxClip, FindsALargeTriangleThatCutsTheCubeWithoutAVertexInIt) {
  const std::array<Vec3, 3> t = {{{-9, -9, 0.2}, {9, -9, 0.2}, {0, 20, 0.2}}};
  EXPECT_TRUE(meets_cube(t, 0.5));
  EXPECT_NEAR(polygon_area(clip_to_cube(t, 0.5)), 1, 1e-12);
  const std::array<Vec3, 3> above = {{{-9, -9, 0.6}, {9, -9, 0.6}, {0, 20, 0.6}}};
  EXPECT_FALSE(meets_cube(above, 0.5));
}

TEST(BoxClip, RejectsATriangleWhoseBoxOnlyOverlapsTheCube) {
  // Passes the box test but runs diagonally past the corner.
  const std::array<Vec3, 3> t = {{{0.4, 0.7, 0}, {0.7, 0.4, 0}, {0.7, 0.7, 0.1}}};
  EXPECT_FALSE(meets_cube(t, 0.5));
}

TEST(BoxClip, SegmentsMeetTheCubeWhenAnyOfTheirPointsDoes) {
  std::mt19937 rng(11);
  int hits = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto t = random_triangle(rng, 1.5);
    bool expected = false;
    for (int k = 0; k <= 400; ++k) expected |= in_cube(t[0] + (t[1] - t[0]) * (k / 400.0), 0.5);
    if (expected) {
      EXPECT_TRUE(segment_meets_cube(t[0], t[1], 0.5)) << "trial " << trial;
    }
    if (segment_meets_cube(t[0], t[1], 0.5)) {
      ++hits;
      bool near = false;
      for (int k = 0; k <= 400; ++k) near |= in_cube(t[0] + (t[1] - t[0]) * (k / 400.0), 0.51);
      EXPECT_TRUE(near) << "trial " << trial;
    }
  }
  EXPECT_GT(hits, 100);
}

TEST(BoxClip, SegmentsAlongAnAxisNeedNoDivision) {
  EXPECT_TRUE(segment_meets_cube({-3, 0.5, 0.5}, {3, 0.5, 0.5}, 0.5));
  EXPECT_FALSE(segment_meets_cube({-3, 0.51, 0.5}, {3, 0.51, 0.5}, 0.5));
  EXPECT_TRUE(segment_meets_cube({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, 0.5));
}

}  // namespace
}  // namespace hexwright
