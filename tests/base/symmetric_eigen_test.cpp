// The eigenvector of the least eigenvalue: of matrices made from known ones, and of degenerate
// ones.
#include "base/symmetric_eigen.h"

#include <random>

#include <gtest/gtest.h>

namespace hexwright {
namespace {

/// sum of value[k] axis[k] axis[k]^T.
std::array<double, 6> from_axes(const std::array<double, 3>& value,
                                const std::array<Vec3, 3>& axis) {
  std::array<double, 6> m{};
  for (std::size_t k = 0; k < 3; ++k) {
    std::size_t entry = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) m[entry++] += value[k] * axis[k][i] * axis[k][j];
  }
  return m;
}

TEST(LeastEigenvector, IsTheAxisOfTheLeastValue) {
  std::mt19937_64 random(61);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Vec3{normal(random), normal(random), normal(random)}; };
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 x = normalized(draw()), y = normalized(cross(x, draw()));
    const double scale = std::ldexp(1.0, trial % 40 - 20);
    const std::array<double, 3> values = {-0.5 * scale, 0.25 * scale, scale};
    const Vec3 v = least_eigenvector(from_axes(values, {x, y, cross(x, y)}));
    EXPECT_NEAR(norm(v), 1, 1e-14);
    EXPECT_NEAR(std::abs(dot(v, x)), 1, 1e-13) << "trial " << trial;
  }
}

TEST(LeastEigenvector, OfPointsInOnePlaneIsItsNormal) {
  const Vec3 x = normalized(Vec3{1, 2, 3}), y = normalized(cross(x, Vec3{0, 0, 1}));
  const Vec3 v = least_eigenvector(from_axes({0, 1, 1e-6}, {x, y, cross(x, y)}));
  EXPECT_NEAR(std::abs(dot(v, x)), 1, 1e-13);
}

TEST(LeastEigenvector, IsAUnitVectorWhereAnyWouldDo) {
  EXPECT_EQ(norm(least_eigenvector({0, 0, 0, 0, 0, 0})), 1);
  EXPECT_EQ(norm(least_eigenvector({2, 0, 0, 2, 0, 2})), 1);
  EXPECT_EQ(least_eigenvector({3, 0, 0, 1, 0, 2}), (Vec3{0, 1, 0}));
}

}  // namespace
}  // namespace hexwright
