#include "hexwright/quality/hex_quality.h"

#include <random>

#include "hexwright/base/parallel.h"

#include "helpers.h"
#include "quality/jacobian/bezier_jacobian.h"

namespace hexwright {
namespace {

using Hex = std::array<Vec3, 8>;

Hex unit_cube() { return test::box_hex_mesh(1, 1, 1).corners(HexId(0)); }

Hex random_hex(std::mt19937& random, double amplitude) {
  std::uniform_real_distribution<double> offset(-amplitude, amplitude);
  Hex p = unit_cube();
  for (Vec3& x : p) x += {offset(random), offset(random), offset(random)};
  return p;
}

// Oracle: the determinant of the trilinear map's derivative, from its shape functions.
double jacobian_at(const Hex& p, const Vec3& u) {
  std::array<Vec3, 3> derivative{};
  for (int lv = 0; lv < 8; ++lv) {
    const int bits = kHexBitsOfVertex[lv];
    for (int axis = 0; axis < 3; ++axis) {
      double factor = 1;
      for (int k = 0; k < 3; ++k) {
        const bool is_high = (bits >> k & 1) != 0;
        if (k == axis)
          factor *= is_high ? 1 : -1;
        else
          factor *= is_high ? u[k] : 1 - u[k];
      }
      derivative[axis] += factor * p[lv];
    }
  }
  return det(derivative[0], derivative[1], derivative[2]);
}

double least_sampled_jacobian(const Hex& p, int n) {
  double least = 1e300;
  for (int x = 0; x <= n; ++x)
    for (int y = 0; y <= n; ++y)
      for (int z = 0; z <= n; ++z)
        least = std::min(least, jacobian_at(p, {double(x) / n, double(y) / n, double(z) / n}));
  return least;
}

TEST(ScaledJacobian, OfACubeIsOneAtAnyScaleAndPlace) {
  for (double scale : {1e-50, 1.0, 1e50}) {
    Hex p = unit_cube();
    for (Vec3& x : p) x = scale * (x + Vec3{3, -2, 5});
    EXPECT_DOUBLE_EQ(scaled_jacobian(p), 1);
  }
}

TEST(ScaledJacobian, OfAShearedCubeIsTheSineOfItsAngle) {
  Hex p = unit_cube();
  for (Vec3& x : p) x.x += 0.75 * x.y;  // edges (1, 0, 0) and (0.75, 1, 0) / 1.25
  EXPECT_NEAR(scaled_jacobian(p), 0.8, 1e-15);
}

TEST(ScaledJacobian, OfAMirroredCubeIsMinusOne) {
  Hex p = unit_cube();
  for (Vec3& x : p) x.x = -x.x;
  EXPECT_DOUBLE_EQ(scaled_jacobian(p), -1);
}

TEST(ScaledJacobian, OfACollapsedEdgeIsMinusOne) {
  Hex p = unit_cube();
  p[6] = p[5];
  EXPECT_EQ(scaled_jacobian(p), -1);
  EXPECT_EQ(corner_scaled_jacobian(p, 6), -1);
  EXPECT_EQ(corner_scaled_jacobian(p, 0), 1);
}

TEST(ScaledJacobian, IsTheLeastOverTheCorners) {
  std::mt19937 random(1);
  for (int k = 0; k < 1000; ++k) {
    const Hex p = random_hex(random, 0.6);
    double least = 1;
    for (int lv = 0; lv < 8; ++lv) {
      const auto& n = kHexCornerNeighbors[lv];
      const Vec3 a = p[n[0]] - p[lv], b = p[n[1]] - p[lv], c = p[n[2]] - p[lv];
      EXPECT_NEAR(corner_scaled_jacobian(p, lv), det(a, b, c) / (norm(a) * norm(b) * norm(c)),
                  1e-14);
      least = std::min(least, corner_scaled_jacobian(p, lv));
    }
    EXPECT_NEAR(scaled_jacobian(p), least, 1e-14);
  }
}

TEST(BezierJacobian, ReproducesTheDeterminantEverywhere) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> parameter(0, 1);
  for (int k = 0; k < 200; ++k) {
    const Hex p = random_hex(random, 1);
    const JacobianBezier b = compute_jacobian_bezier(p);
    const Vec3 u = {parameter(random), parameter(random), parameter(random)};
    double value = 0;
    for (int i = 0; i < 27; ++i) {
      double basis = 1;
      for (int axis = 0, rest = i; axis < 3; ++axis, rest /= 3) {
        const double t = u[axis];
        basis *= rest % 3 == 0 ? (1 - t) * (1 - t) : rest % 3 == 1 ? 2 * t * (1 - t) : t * t;
      }
      value += b[i] * basis;
    }
    EXPECT_NEAR(value, jacobian_at(p, u), 1e-12);
  }
}

TEST(BezierJacobian, SubdivisionDescribesTheSamePolynomial) {
  std::mt19937 random(3);
  const Hex p = random_hex(random, 1);
  const auto parts = subdivide(compute_jacobian_bezier(p));
  for (int part = 0; part < 8; ++part)
    for (int corner = 0; corner < 8; ++corner) {
      Vec3 u;
      int index = 0;
      for (int axis = 0, stride = 1; axis < 3; ++axis, stride *= 3) {
        u[axis] = 0.5 * ((part >> axis & 1) + (corner >> axis & 1));
        index += stride * 2 * (corner >> axis & 1);
      }
      EXPECT_NEAR(parts[part][index], jacobian_at(p, u), 1e-13);
    }
}

TEST(Positivity, AgreesWithDenseSampling) {
  std::mt19937 random(4);
  std::array<int, 3> count{};
  for (int k = 0; k < 600; ++k) {
    const Hex p = random_hex(random, 0.25 + 0.001 * k);
    const Positivity result = check_positivity(p);
    ++count[static_cast<std::size_t>(result)];
    const double least = least_sampled_jacobian(p, 12);
    if (result == Positivity::Positive) {
      EXPECT_GT(least, 0) << "hex " << k;
    }
    if (least <= 0) {
      EXPECT_EQ(result, Positivity::NotPositive) << "hex " << k;
    }
  }
  EXPECT_GT(count[0], 100);
  EXPECT_GT(count[1], 100);
  EXPECT_EQ(count[2], 0);
}

// Hexes that only subdivision can decide: all corners positive, some coefficient negative.
TEST(Positivity, SeesInsideElementsWithPositiveCorners) {
  std::mt19937 random(5);
  int num_positive = 0;
  int num_not_positive = 0;
  for (int k = 0; k < 20000; ++k) {
    const Hex p = random_hex(random, 0.6);
    const JacobianBezier b = compute_jacobian_bezier(p);
    if (scaled_jacobian(p) <= 0 || *std::min_element(b.begin(), b.end()) > 0) continue;
    const double least = least_sampled_jacobian(p, 10);
    const Positivity result = check_positivity(p);
    if (result == Positivity::Positive) {
      ++num_positive;
      EXPECT_GT(least, 0);
    } else if (result == Positivity::NotPositive) {
      ++num_not_positive;
      EXPECT_LT(least, 0.05);  // the sampling is coarse, but it must be near
    }
  }
  EXPECT_GT(num_positive, 10);
  EXPECT_GT(num_not_positive, 10);
}

TEST(Positivity, AFlatHexIsNotPositive) {
  Hex p = unit_cube();
  for (Vec3& x : p) x.z = 0;
  EXPECT_EQ(check_positivity(p), Positivity::NotPositive);
}

TEST(HexVolume, IsTheIntegralOfTheDeterminant) {
  std::mt19937 random(6);
  const double gauss[2] = {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};
  for (int k = 0; k < 100; ++k) {
    const Hex p = random_hex(random, 1);
    double integral = 0;  // two points per direction integrate degree 3 exactly
    for (double x : gauss)
      for (double y : gauss)
        for (double z : gauss) integral += jacobian_at(p, {x, y, z}) / 8;
    EXPECT_NEAR(hex_volume(p), integral, 1e-13);
  }
}

TEST(QualitySummary, CountsEveryHexOnce) {
  HexMesh mesh = test::box_hex_mesh(4, 3, 2);
  std::swap(mesh.hexes[HexId(7)][0], mesh.hexes[HexId(7)][1]);
  std::swap(mesh.hexes[HexId(7)][3], mesh.hexes[HexId(7)][2]);
  std::swap(mesh.hexes[HexId(7)][4], mesh.hexes[HexId(7)][5]);
  std::swap(mesh.hexes[HexId(7)][7], mesh.hexes[HexId(7)][6]);
  const QualitySummary summary = summarize_quality(mesh);
  EXPECT_EQ(summary.num_hexes, 24u);
  EXPECT_EQ(summary.num_inverted, 1u);
  EXPECT_EQ(summary.num_not_positive, 1u);
  EXPECT_EQ(summary.num_undecided, 0u);
  EXPECT_EQ(summary.worst_hex, HexId(7));
  EXPECT_EQ(summary.min_scaled_jacobian, -1);
  EXPECT_NEAR(summary.avg_scaled_jacobian, 22.0 / 24, 1e-15);
  EXPECT_EQ(summary.histogram[19], 23u);
  EXPECT_EQ(summary.histogram[0], 1u);
  EXPECT_NEAR(summary.total_volume, 22, 1e-12);
}

TEST(QualitySummary, IsTheSameForAnyNumberOfThreads) {
  HexMesh mesh = test::box_hex_mesh(40, 30, 20);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> offset(-0.3, 0.3);
  for (Vec3& p : mesh.positions) p += {offset(random), offset(random), offset(random)};
  std::vector<QualitySummary> results;
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    results.push_back(summarize_quality(mesh));
  }
  EXPECT_EQ(results[0].avg_scaled_jacobian, results[1].avg_scaled_jacobian);
  EXPECT_EQ(results[0].total_volume, results[1].total_volume);
  EXPECT_EQ(results[0].worst_hex, results[1].worst_hex);
  EXPECT_EQ(results[0].histogram, results[1].histogram);
}

TEST(QualitySummary, OfNoHexesIsZero) {
  const QualitySummary summary = summarize_quality(HexMesh{});
  EXPECT_EQ(summary.num_hexes, 0u);
  EXPECT_FALSE(summary.worst_hex.is_valid());
}

}  // namespace
}  // namespace hexwright
