// Vectors and boxes: algebraic identities on random input, and the edges of the number range.
#include "hexwright/base/vec3.h"

#include <random>

#include <gtest/gtest.h>

namespace hexwright {
namespace {

Vec3 random_vec(std::mt19937& random) {
  const auto one = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
  const double x = one(), y = one(), z = one();
  return {x, y, z};
}

TEST(Vec3, ProductsKeepTheirIdentities) {
  std::mt19937 random(11);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = random_vec(random), b = random_vec(random), c = random_vec(random);
    EXPECT_EQ(cross(a, b), -cross(b, a));
    EXPECT_NEAR(dot(cross(a, b), a), 0, 1e-15);
    EXPECT_NEAR(norm_sq(cross(a, b)), norm_sq(a) * norm_sq(b) - dot(a, b) * dot(a, b), 1e-14);
    EXPECT_NEAR(det(a, b, c), det(b, c, a), 1e-15);
    EXPECT_NEAR(det(a, b, c), -det(b, a, c), 1e-15);
    // a x (b x c) = b (a.c) - c (a.b)
    EXPECT_NEAR(norm(cross(a, cross(b, c)) - (b * dot(a, c) - c * dot(a, b))), 0, 1e-14);
  }
}

TEST(Vec3, NormalizedHasLengthOneOrIsZero) {
  std::mt19937 random(12);
  for (int i = 0; i < 1000; ++i) EXPECT_NEAR(norm(normalized(random_vec(random))), 1, 1e-15);
  EXPECT_EQ(normalized({}), Vec3{});
  EXPECT_EQ(normalized({1e-200, 0, 0}), Vec3{});  // the square underflows: no direction is made up
}

TEST(Vec3, FiniteMeansEveryCoordinate) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(is_finite({1e308, -1e308, 5e-324}));
  for (double bad : {nan, infinity, -infinity})
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 p;
      p[axis] = bad;
      EXPECT_FALSE(is_finite(p)) << bad << " on axis " << axis;
    }
}

TEST(Box3, HoldsWhatItWasExtendedBy) {
  std::mt19937 random(13);
  Box3 box;
  EXPECT_TRUE(box.is_empty());
  EXPECT_EQ(box.diagonal(), 0);
  std::vector<Vec3> points;
  for (int i = 0; i < 50; ++i) {
    points.push_back(random_vec(random));
    box.extend(points.back());
    for (const Vec3& p : points) EXPECT_TRUE(box.contains(p));
  }
  // Tight: each side passes through a point.
  for (int axis = 0; axis < 3; ++axis) {
    const auto on = [&](double side) {
      return std::any_of(points.begin(), points.end(),
                         [&](const Vec3& p) { return p[axis] == side; });
    };
    EXPECT_TRUE(on(box.lo[axis]) && on(box.hi[axis]));
  }
  EXPECT_FALSE(box.contains(box.hi + Vec3{1e-9, 0, 0}));
}

TEST(Box3, ExtendingByAnEmptyBoxChangesNothing) {
  Box3 box;
  box.extend(Vec3{1, 2, 3});
  const Box3 before = box;
  box.extend(Box3{});
  EXPECT_EQ(box.lo, before.lo);
  EXPECT_EQ(box.hi, before.hi);
  EXPECT_FALSE(box.is_empty());
}

}  // namespace
}  // namespace hexwright
