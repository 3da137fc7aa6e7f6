// What the surface foretells about the mesh's boundary.
#include "hexwright/geometry/expected_topology.h"

#include <cmath>

#include <gtest/gtest.h>

#include "helpers.h"

namespace hexwright {
namespace {

/// Appends a cube with the given low corner and edge; inside out when `is_cavity`.
void add_cube(TriMesh& surface, const Vec3& corner, double edge, bool is_cavity = false) {
  const TriMesh cube = test::unit_cube_surface();
  const auto base = static_cast<std::int32_t>(surface.num_verts());
  for (const Vec3& p : cube.positions) surface.positions.push_back(p * edge + corner);
  for (auto t : cube.tris) {
    if (is_cavity) std::swap(t[0], t[1]);
    for (VertId& v : t) v = VertId(v.value() + base);
    surface.tris.push_back(t);
  }
}

ExpectedTopology expect(TriMesh surface) {
  return find_expected_topology(SurfaceTree(std::move(surface)));
}

TEST(ExpectedTopology, CountsSeparatePartsAndCavities) {
  TriMesh surface;
  add_cube(surface, {0, 0, 0}, 1);
  ExpectedTopology e = expect(surface);
  EXPECT_TRUE(e.is_known);
  EXPECT_EQ(e.num_components, 1u);
  EXPECT_EQ(e.euler_characteristic, 2);
  add_cube(surface, {0.3, 0.3, 0.3}, 0.4, true);
  add_cube(surface, {3, 0, 0}, 1);
  e = expect(surface);
  EXPECT_TRUE(e.is_known);
  EXPECT_EQ(e.num_components, 3u);
  EXPECT_EQ(e.genus(), 0);
}

// Along a knife's edge the solid is thinner than any step off the surface; the slivers there do not
// make the rest uncertain.
TEST(ExpectedTopology, IsKnownForABladeWithManySliversAtItsEdge) {
  TriMesh blade;
  const int n = 400;  // strips on each side, ever narrower towards the edge at x = 0
  for (int i = 0; i <= n; ++i)
    for (double y : {0.0, 1.0})
      for (double side : {-1.0, 1.0}) {
        const double x = i == 0 ? 0 : std::pow(0.97, n - i);
        blade.positions.push_back({x, y, side * 0.05 * x});
      }
  const auto id = [](int i, int y, int side) {
    return VertId(i == 0 ? 2 * y : 4 * i + 2 * y + side);
  };
  const auto quad = [&](VertId a, VertId b, VertId c, VertId d) {
    if (a != b && b != c && c != a) blade.tris.push_back({a, b, c});
    if (a != c && c != d && d != a) blade.tris.push_back({a, c, d});
  };
  for (int i = 0; i < n; ++i) {
    quad(id(i, 0, 1), id(i + 1, 0, 1), id(i + 1, 1, 1), id(i, 1, 1));
    quad(id(i, 1, 0), id(i + 1, 1, 0), id(i + 1, 0, 0), id(i, 0, 0));
    quad(id(i, 0, 0), id(i + 1, 0, 0), id(i + 1, 0, 1), id(i, 0, 1));
    quad(id(i, 1, 1), id(i + 1, 1, 1), id(i + 1, 1, 0), id(i, 1, 0));
  }
  quad(id(n, 0, 0), id(n, 1, 0), id(n, 1, 1), id(n, 0, 1));
  const ExpectedTopology e = expect(blade);
  EXPECT_TRUE(e.is_known);
  EXPECT_TRUE(e.is_all_boundary());
  EXPECT_EQ(e.num_components, 1u);
  EXPECT_EQ(e.euler_characteristic, 2);
}

TEST(ExpectedTopology, LeavesOutPartsHiddenInTheSolid) {
  TriMesh surface;
  add_cube(surface, {0, 0, 0}, 1);
  add_cube(surface, {0.3, 0.3, 0.3}, 0.4);
  const ExpectedTopology e = expect(surface);
  EXPECT_FALSE(e.is_all_boundary());
  EXPECT_EQ(e.num_hidden, 1u);
  EXPECT_TRUE(e.is_known);
  EXPECT_EQ(e.num_components, 1u);
}

TEST(ExpectedTopology, IsUnknownWherePartsOverlapOrTheSurfaceIsOpen) {
  TriMesh overlapping;
  add_cube(overlapping, {0, 0, 0}, 1);
  add_cube(overlapping, {0.5, 0.4, 0.3}, 1);
  EXPECT_FALSE(expect(overlapping).is_known);
  TriMesh open;
  add_cube(open, {0, 0, 0}, 1);
  open.tris.raw().pop_back();
  EXPECT_FALSE(expect(open).is_known);
}

}  // namespace
}  // namespace hexwright
