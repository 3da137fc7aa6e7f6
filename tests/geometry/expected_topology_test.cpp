// What the surface foretells about the mesh's boundary.
#include "hexwright/geometry/expected_topology.h"

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

TEST(ExpectedTopology, LeavesOutPartsHiddenInTheSolid) {
  TriMesh surface;
  add_cube(surface, {0, 0, 0}, 1);
  add_cube(surface, {0.3, 0.3, 0.3}, 0.4);
  const ExpectedTopology e = expect(surface);
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
