#include "hexwright/geometry/exposure.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/random_soup.h"
#include "solids.h"

namespace hexwright {
namespace {

void append_cube(TriMesh& to, double size, const Vec3& low, bool reversed) {
  const TriMesh cube = test::box_surface(low, low + Vec3{size, size, size});
  append(to, reversed ? test::reversed(cube) : cube);
}

Vec3 random_in_triangle(std::mt19937_64& random, const std::array<Vec3, 3>& c) {
  const Vec3 r = test::random_point(random) * 0.5 + Vec3{0.5, 0.5, 0.5};
  const double a = 1 - std::sqrt(r.x), b = std::sqrt(r.x) * r.y;
  return c[0] * (1 - a - b) + c[1] * a + c[2] * b;
}

bool is_in_box(const Vec3& p, const Vec3& low, double size) {
  return Box3{low, low + Vec3{size, size, size}}.contains(p);
}

TEST(Exposure, EveryPointOfAClosedSurfaceBoundsIt) {
  std::mt19937_64 random(5);
  for (const TriMesh& shape : {test::unit_cube_surface(), test::unit_sphere_surface(2)}) {
    const SurfaceTree tree(shape);
    for (TriId t : shape.tris.ids()) {
      for (const Vec3& corner : shape.corners(t)) EXPECT_TRUE(bounds_solid(tree, t, corner));
      EXPECT_TRUE(bounds_solid(tree, t, random_in_triangle(random, shape.corners(t))));
    }
  }
}

/// The ridge of a long wedge along x, with `count` needles on each side of it next to the ridge.
TriMesh needle_wedge(double angle, double width, int count) {
  TriMesh t;  // per end: the ridge, then rows of points down both sides, then the back
  const double s = std::sin(angle / 2), c = std::cos(angle / 2);
  std::vector<Vec3> outline{{0, 0, 0}};
  for (int i = 1; i <= count; ++i) outline.push_back({0, s * width * i, -c * width * i});
  for (int i = count; i >= 1; --i) outline.push_back({0, -s * width * i, -c * width * i});
  const auto n = static_cast<int>(outline.size());
  for (double x : {0.0, 1.0})
    for (const Vec3& p : outline) t.positions.push_back({x, p.y, p.z});
  const auto add = [&](int a, int b, int d) {
    t.tris.push_back({VertId(a), VertId(b), VertId(d)});
  };
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    add(i, j + n, j);
    add(i, i + n, j + n);
  }
  for (int i = 1; i + 1 < n; ++i) {
    add(0, i, i + 1);
    add(n, n + i + 1, n + i);
  }
  return t;
}

// The step off a needle must not leave the wedge by its other side.
TEST(Exposure, RidgesBetweenNeedlesBoundTheirWedgeSeenClosely) {
  for (double degrees : {10.0, 20.0, 60.0})
    for (double width : {1e-2, 1e-3, 1e-5}) {
      const TriMesh wedge = needle_wedge(degrees * std::numbers::pi / 180, width, 3);
      const SurfaceTree tree(wedge);
      for (int i = 0; i < 14; ++i) {  // those along the ridge; the ends are triangulated badly
        const TriId t(i);
        const auto c = wedge.corners(t);
        for (double along : {0.0, 0.1, 0.5, 1.0})
          EXPECT_TRUE(bounds_solid_closely(tree, t, c[0] + (c[1] - c[0]) * along))
              << degrees << " " << width;
      }
    }
}

// Two overlapping cubes: a point of one bounds the union exactly when the other does not hold it.
TEST(Exposure, AgreesWithTheUnionOfOverlappingCubes) {
  const Vec3 low = {0.4, 0.3, 0.2};
  TriMesh two;
  append_cube(two, 1, {}, false);
  append_cube(two, 1, low, false);
  const SurfaceTree tree(two);
  std::mt19937_64 random(6);
  int num_buried = 0;
  for (TriId t : two.tris.ids())
    for (int i = 0; i < 100; ++i) {
      // Away from where the surfaces cross, since the probe moves by a share of the triangle.
      const Vec3 p = random_in_triangle(random, two.corners(t));
      const Vec3 other = t.value() < 12 ? low : Vec3{};
      const bool is_inside = is_in_box(p, other + Vec3{0.03, 0.03, 0.03}, 0.94);
      if (is_inside != is_in_box(p, other - Vec3{0.03, 0.03, 0.03}, 1.06)) continue;
      EXPECT_EQ(bounds_solid(tree, t, p), !is_inside) << p.x << " " << p.y << " " << p.z;
      num_buried += is_inside;
    }
  EXPECT_GT(num_buried, 200);
}

TEST(Exposure, CavitiesBoundAndShellsOfEqualOrientationDoNot) {
  for (bool reversed : {true, false}) {
    TriMesh nested;
    append_cube(nested, 1, {}, false);
    append_cube(nested, 0.5, {0.2, 0.2, 0.2}, reversed);
    const SurfaceTree tree(nested);
    for (TriId t : nested.tris.ids()) {
      const auto c = nested.corners(t);
      EXPECT_EQ(bounds_solid(tree, t, (c[0] + c[1] + c[2]) / 3), reversed || t.value() < 12);
    }
  }
}

TEST(Exposure, CloselySeenAgreesOnShapelyTriangles) {
  TriMesh nested;
  append_cube(nested, 1, {}, false);
  append_cube(nested, 0.5, {0.2, 0.2, 0.2}, false);
  const SurfaceTree tree(nested);
  std::mt19937_64 random(8);
  for (TriId t : nested.tris.ids())
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = random_in_triangle(random, nested.corners(t));
      EXPECT_EQ(bounds_solid_closely(tree, t, p), bounds_solid(tree, t, p));
    }
}

TEST(Exposure, ADoubledSheetAndATriangleWithoutAreaBoundNothing) {
  TriMesh sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
  sheet.tris = {{VertId(0), VertId(1), VertId(2)},
                {VertId(0), VertId(2), VertId(1)},
                {VertId(0), VertId(1), VertId(3)}};
  const SurfaceTree tree(sheet);
  EXPECT_FALSE(bounds_solid(tree, TriId(0), {0.2, 0.2, 0}));
  EXPECT_FALSE(bounds_solid(tree, TriId(2), {0.5, 0, 0}));
}

}  // namespace
}  // namespace hexwright
