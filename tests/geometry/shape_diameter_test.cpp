#include "hexwright/geometry/shape_diameter.h"

#include <gtest/gtest.h>

#include "hexwright/base/parallel.h"

#include "solids.h"

namespace hexwright {
namespace {

/// A box of the given size at the origin, every side of n x n squares.
TriMesh box_surface(const Vec3& size, int n) {
  TriMesh out;
  const TriMesh cube = test::unit_cube_surface();
  for (int side = 0; side < 6; ++side) {
    const Vec3 a = cube.corners(TriId(2 * side))[0];
    const Vec3 u = cube.corners(TriId(2 * side))[1] - a;
    const Vec3 v = cube.corners(TriId(2 * side + 1))[2] - a;
    const auto at = [&](int i, int j) {
      const Vec3 p = a + u * (double(i) / n) + v * (double(j) / n);
      return out.positions.push_back({p.x * size.x, p.y * size.y, p.z * size.z});
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const VertId q[4] = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
        out.tris.push_back({q[0], q[1], q[2]});
        out.tris.push_back({q[0], q[2], q[3]});
      }
  }
  return out;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(ShapeDiameter, SphereIsNearlyItsDiameter) {
  const auto sphere = test::unit_sphere_surface(3);
  for (double d : compute_shape_diameter(sphere, {}, {})) {
    EXPECT_GT(d, 1.5);  // chords at 60 degrees measure half the diameter
    EXPECT_LT(d, 2.0);
  }
}

TEST(ShapeDiameter, NarrowConeMeasuresTheThicknessOfASlab) {
  for (double t : {0.2, 1e-3, 1e-5}) {
    const auto slab = box_surface({1, 1, t}, 6);
    ShapeDiameterOptions narrow;
    narrow.cone_angle = 0.02;
    const auto diameter = compute_shape_diameter(slab, narrow, {});
    for (TriId i : slab.tris.ids()) {
      const auto c = slab.corners(i);
      if (c[0].z == c[1].z && c[1].z == c[2].z) {
        EXPECT_NEAR(diameter[i], t, t * 1e-3);
      }
    }
  }
}

TEST(ShapeDiameter, FollowsScaleAndPosition) {
  const auto sphere = box_surface({1, 0.3, 0.1}, 5);
  const auto reference = compute_shape_diameter(sphere, {}, {});
  for (double scale : {1e-150, 1e-20, 1e30, 1e150}) {
    TriMesh moved = sphere;
    for (Vec3& p : moved.positions) p = (p + Vec3{100, -100, 50}) * scale;
    const auto diameter = compute_shape_diameter(moved, {}, {});
    for (TriId t : sphere.tris.ids())
      EXPECT_NEAR(diameter[t] / scale, reference[t], 1e-3 * reference[t]) << scale;
  }
}

TEST(ShapeDiameter, FlippedInputIsInfinite) {
  const TriMesh sphere = test::reversed(test::unit_sphere_surface(2));
  for (double d : compute_shape_diameter(sphere, {}, {})) EXPECT_EQ(d, kInfinity);
}

TEST(ShapeDiameter, AnOpenSheetIsInfinite) {
  TriMesh sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  sheet.tris = {{VertId(0), VertId(1), VertId(2)}};
  EXPECT_EQ(compute_shape_diameter(sheet, {}, {})[TriId(0)], kInfinity);
}

TEST(OppositeWalls, SlabHasItsThicknessInsideAndNothingOutside) {
  const double t = 0.05;
  const auto slab = box_surface({1, 1, t}, 1);
  const auto samples = sample_opposite_walls(slab, 0.1, {});
  EXPECT_GT(samples.size(), 150u);
  for (const auto& s : samples) {
    EXPECT_EQ(s.outer, kInfinity);
    const bool is_wide = s.point.z < 1e-9 || s.point.z > t - 1e-9;
    EXPECT_NEAR(s.inner, is_wide ? t : 1, 1e-6);
  }
}

TEST(OppositeWalls, GapBetweenTwoBoxesIsMeasuredOutside) {
  TriMesh both = box_surface({1, 1, 1}, 2);
  TriMesh other = both;
  for (Vec3& p : other.positions) p += {1.25, 0, 0};
  append(both, other);
  for (const auto& s : sample_opposite_walls(both, 0.2, {})) {
    const bool at_gap = std::abs(s.point.x - 1) < 1e-9 || std::abs(s.point.x - 1.25) < 1e-9;
    if (at_gap)
      EXPECT_NEAR(s.outer, 0.25, 1e-6);
    else
      EXPECT_EQ(s.outer, kInfinity);
    EXPECT_NEAR(s.inner, 1, 1e-6);
  }
}

TEST(OppositeWalls, SamplesAreSpreadByTheSpacing) {
  const auto cube = test::unit_cube_surface();
  for (double spacing : {0.5, 0.1, 0.03}) {
    const auto samples = sample_opposite_walls(cube, spacing, {});
    const double expected = 6 / (spacing * spacing);
    EXPECT_GT(double(samples.size()), expected * 0.5);
    EXPECT_LT(double(samples.size()), expected * 4);
  }
  EXPECT_EQ(sample_opposite_walls(cube, 100, {}).size(), 12u);
  EXPECT_THROW(sample_opposite_walls(cube, 1e-9, {}), Error);
  EXPECT_THROW(sample_opposite_walls(cube, 0, {}), Error);
}

TEST(OppositeWalls, DoNotDependOnThreads) {
  const auto slab = box_surface({1, 0.5, 0.1}, 9);
  const auto many = sample_opposite_walls(slab, 0.02, {});
  const ThreadLimit one(1);
  const auto single = sample_opposite_walls(slab, 0.02, {});
  ASSERT_EQ(many.size(), single.size());
  for (std::size_t i = 0; i < many.size(); ++i) {
    EXPECT_EQ(many[i].inner, single[i].inner);
    EXPECT_EQ(many[i].outer, single[i].outer);
    EXPECT_EQ(many[i].point, single[i].point);
  }
}

// Half a million triangles smaller than the spacing: far fewer samples, all over the surface.
TEST(OppositeWalls, AreSampledBySpacingAndNotByTriangle) {
  const TriMesh sphere = test::unit_sphere_surface(8);
  ASSERT_GT(sphere.num_tris(), 500'000u);
  const std::vector<WallSample> walls = sample_opposite_walls(sphere, 0.05, {});
  EXPECT_LT(walls.size(), 250'000u);
  std::vector<std::size_t> per_side(8, 0);
  for (const WallSample& wall : walls) {
    EXPECT_GT(wall.inner, 1.5);
    const Vec3& p = wall.point;
    ++per_side[std::size_t(p.x > 0) + 2 * std::size_t(p.y > 0) + 4 * std::size_t(p.z > 0)];
  }
  for (const std::size_t count : per_side) EXPECT_GT(count, walls.size() / 10);
}

}  // namespace
}  // namespace hexwright
