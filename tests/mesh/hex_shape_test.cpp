#include "hexwright/mesh/hex_shape.h"

#include <random>

#include <gtest/gtest.h>

namespace hexwright {
namespace {

std::array<Vec3, 8> unit_cube() {
  std::array<Vec3, 8> p;
  for (std::size_t b = 0; b < 8; ++b)
    p[static_cast<std::size_t>(kHexVertexOfBits[b])] = {
        static_cast<double>(b & 1), static_cast<double>(b >> 1 & 1), static_cast<double>(b >> 2)};
  return p;
}

// From the corners' bits alone: the edges along x, y and z, pointing to larger coordinates.
double brute_force(const std::array<Vec3, 8>& p, int lv) {
  const int bits = kHexBitsOfVertex[static_cast<std::size_t>(lv)];
  std::array<Vec3, 3> e;
  for (int axis = 0; axis < 3; ++axis) {
    const auto low = static_cast<std::size_t>(bits & ~(1 << axis));
    const auto high = static_cast<std::size_t>(bits | 1 << axis);
    e[static_cast<std::size_t>(axis)] = p[static_cast<std::size_t>(kHexVertexOfBits[high])] -
                                        p[static_cast<std::size_t>(kHexVertexOfBits[low])];
  }
  const double volume = e[0].x * (e[1].y * e[2].z - e[1].z * e[2].y) -
                        e[0].y * (e[1].x * e[2].z - e[1].z * e[2].x) +
                        e[0].z * (e[1].x * e[2].y - e[1].y * e[2].x);
  return volume / (norm(e[0]) * norm(e[1]) * norm(e[2]));
}

TEST(HexShape, AgreesWithTheFormulaOnRandomHexes) {
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> offset(-0.7, 0.7);  // many of them inverted
  int num_inverted = 0;
  for (int trial = 0; trial < 500; ++trial) {
    auto p = unit_cube();
    for (Vec3& x : p) x += {offset(rng), offset(rng), offset(rng)};
    double least = 1;
    for (int lv = 0; lv < 8; ++lv) {
      EXPECT_NEAR(corner_scaled_jacobian(p, lv), brute_force(p, lv), 1e-12) << "corner " << lv;
      least = std::min(least, brute_force(p, lv));
    }
    EXPECT_NEAR(scaled_jacobian(p), least, 1e-12);
    num_inverted += least < 0;
  }
  EXPECT_GT(num_inverted, 50);
  EXPECT_LT(num_inverted, 500);
}

TEST(HexShape, KnowsNoScale) {
  std::mt19937 rng(8);
  std::uniform_real_distribution<double> offset(-0.2, 0.2);
  auto p = unit_cube();
  for (Vec3& x : p) x += {offset(rng), offset(rng), offset(rng)};
  for (double scale : {1e-12, 1e-3, 1e6, 1e12}) {
    auto scaled = p;
    for (Vec3& x : scaled) x *= scale;
    EXPECT_NEAR(scaled_jacobian(scaled), scaled_jacobian(p), 1e-12) << scale;
    for (int lv = 0; lv < 8; ++lv)
      EXPECT_NEAR(corner_scaled_jacobian(scaled, lv), corner_scaled_jacobian(p, lv), 1e-12);
  }
}

TEST(HexShape, EdgeWithoutLengthCountsAsInverted) {
  auto p = unit_cube();
  p[1] = p[0];
  EXPECT_EQ(corner_scaled_jacobian(p, 0), -1);
  EXPECT_EQ(corner_scaled_jacobian(p, 1), -1);
  EXPECT_EQ(corner_scaled_jacobian(p, 7), 1);
  EXPECT_EQ(scaled_jacobian(p), -1);
}

}  // namespace
}  // namespace hexwright
