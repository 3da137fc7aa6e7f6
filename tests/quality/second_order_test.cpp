// The Jacobian of elements of second order against their shape functions.
#include <random>

#include "hexwright/quality/hex_quality.h"
#include "hexwright/quality/judge.h"

#include "helpers.h"
#include "quality/jacobian/quadratic_jacobian.h"

namespace hexwright {
namespace {

/// Place of each node in [0, 1]^3, from the cube of unit edges.
QuadraticHex cube_nodes() { return quadratic_hex(test::box_hex_mesh(1, 1, 1), HexId(0)); }

QuadraticHex random_nodes(std::mt19937& random, double amplitude) {
  std::uniform_real_distribution<double> offset(-amplitude, amplitude);
  QuadraticHex nodes = cube_nodes();
  for (Vec3& p : nodes) p += {offset(random), offset(random), offset(random)};
  return nodes;
}

/// Lagrange function of degree 2 that is 1 at `node` (0, 1/2 or 1), or its derivative.
double lagrange(double node, double t, bool derive) {
  double value = derive ? 0 : 1;
  for (double a : {0.0, 0.5, 1.0}) {
    if (a == node) continue;
    double others = 1 / (node - a);
    for (double b : {0.0, 0.5, 1.0})
      if (b != node && b != a) others *= (derive ? t - b : 1) / (derive ? node - b : 1);
    if (derive)
      value += others;
    else
      value *= (t - a) / (node - a);
  }
  return value;
}

double jacobian_at(const QuadraticHex& nodes, const Vec3& u) {
  const QuadraticHex places = cube_nodes();
  std::array<Vec3, 3> derivative{};
  for (std::size_t n = 0; n < 27; ++n)
    for (int axis = 0; axis < 3; ++axis) {
      double factor = 1;
      for (int k = 0; k < 3; ++k) factor *= lagrange(places[n][k], u[k], k == axis);
      derivative[static_cast<std::size_t>(axis)] += factor * nodes[n];
    }
  return det(derivative[0], derivative[1], derivative[2]);
}

double bernstein_5(std::size_t i, double t) {
  constexpr double kBinomial[6] = {1, 5, 10, 10, 5, 1};
  return kBinomial[i] * std::pow(t, double(i)) * std::pow(1 - t, 5.0 - double(i));
}

double value_of(const QuadraticBezier& bezier, const Vec3& u) {
  double sum = 0;
  for (std::size_t i = 0; i < 216; ++i)
    sum += bezier[i] * bernstein_5(i % 6, u.x) * bernstein_5(i / 6 % 6, u.y) *
           bernstein_5(i / 36, u.z);
  return sum;
}

TEST(QuadraticJacobian, IsThatOfTheShapeFunctions) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(0, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const QuadraticHex nodes = random_nodes(random, 0.3);
    const QuadraticBezier bezier = compute_quadratic_bezier(nodes);
    for (int point = 0; point < 10; ++point) {
      const Vec3 u = {at(random), at(random), at(random)};
      EXPECT_NEAR(value_of(bezier, u), jacobian_at(nodes, u), 1e-11);
    }
    const auto at_nodes = jacobians_at_nodes(nodes);
    for (std::size_t n = 0; n < 27; ++n)
      EXPECT_NEAR(at_nodes[n], jacobian_at(nodes, cube_nodes()[n]), 1e-11);
  }
}

TEST(QuadraticJacobian, OfTheHalvesIsTheSamePolynomial) {
  std::mt19937 random(6);
  const QuadraticBezier bezier = compute_quadratic_bezier(random_nodes(random, 0.2));
  const auto parts = subdivide(bezier);
  for (std::size_t part = 0; part < 8; ++part) {
    const Vec3 corner = {double(part & 1), double(part >> 1 & 1), double(part >> 2 & 1)};
    const Vec3 u = {0.3, 0.8, 0.1};
    EXPECT_NEAR(value_of(parts[part], u), value_of(bezier, 0.5 * (corner + u)), 1e-12);
  }
}

TEST(QuadraticJacobian, WithStraightEdgesIsThatOfTheTrilinearHex) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> offset(-0.3, 0.3);
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  for (Vec3& p : mesh.positions) p += {offset(random), offset(random), offset(random)};
  const auto volume = volume_of(compute_quadratic_bezier(quadratic_hex(mesh, HexId(0))));
  EXPECT_NEAR(volume, hex_volume(mesh.corners(HexId(0))), 1e-13);
}

TEST(QuadraticJacobian, ProvesWhatSamplesCannotRefute) {
  std::mt19937 random(8);
  int num_positive = 0, num_not = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const QuadraticHex nodes = random_nodes(random, 0.13);
    double least = 1e300;
    for (int x = 0; x <= 6; ++x)
      for (int y = 0; y <= 6; ++y)
        for (int z = 0; z <= 6; ++z)
          least = std::min(least, jacobian_at(nodes, {x / 6.0, y / 6.0, z / 6.0}));
    const Positivity positivity = check_positivity(nodes);
    if (positivity == Positivity::Positive) {
      ++num_positive;
      EXPECT_GT(least, 0);
      EXPECT_NE(check_positivity(nodes, least * 1.0001), Positivity::Positive);
    }
    if (least < -1e-3) {
      ++num_not;
      EXPECT_EQ(positivity, Positivity::NotPositive);
    }
  }
  EXPECT_GT(num_positive, 20);
  EXPECT_GT(num_not, 20);
}

TEST(SecondOrder, NamesTheHexesThatAreBroken) {
  HexMesh mesh = test::box_hex_mesh(3, 1, 1);
  mesh.mid_nodes = make_straight_mid_nodes(mesh);
  EXPECT_TRUE(judge(mesh, {}, {}).is_valid());
  // An edge of the last hex whose node is beyond the quarter of its length.
  mesh.mid_nodes->edges[mesh.mid_nodes->hex_to_edge[HexId(2)][9]] = {3, 0, 0.2};
  const Verdict verdict = judge(mesh, {}, {});
  ASSERT_TRUE(verdict.second_order);
  EXPECT_EQ(verdict.second_order->broken, std::vector<HexId>{HexId(2)});
  EXPECT_EQ(verdict.second_order->num_curved, 1u);
  ASSERT_EQ(verdict.failures.size(), 1u);
  EXPECT_NE(verdict.failures[0].find("hex 2"), std::string::npos) << verdict.failures[0];
}

TEST(SecondOrder, VolumeIsThatOfTheCurvedElements) {
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  mesh.mid_nodes = make_straight_mid_nodes(mesh);
  // The top's four edges up by 0.1: its middle rises by 0.2, and the mean by 2/3 of that.
  for (std::size_t le : {4, 5, 6, 7})
    mesh.mid_nodes->edges[mesh.mid_nodes->hex_to_edge[HexId(0)][le]].z += 0.1;
  EXPECT_NEAR(summarize_second_order(mesh).total_volume, 1 + 0.4 / 3, 1e-13);
}

}  // namespace
}  // namespace hexwright
