#include "hexwright/geometry/surface_topology.h"

#include <gtest/gtest.h>

#include "helpers.h"
#include "mesh/tri_measures.h"

namespace hexwright {
namespace {

void append_moved(TriMesh& to, TriMesh from, const Vec3& shift) {
  for (Vec3& p : from.positions) p += shift;
  append(to, from);
}

/// A torus of n x m quads.
TriMesh torus(int n, int m) {
  TriMesh mesh;
  for (int i = 0; i < n * m; ++i) mesh.positions.push_back({});
  const auto id = [&](int i, int j) { return VertId((i % n) * m + j % m); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      mesh.tris.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.tris.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return mesh;
}

TEST(Topology, CubeIsASphere) {
  const auto t = compute_topology(test::unit_cube_surface());
  EXPECT_TRUE(t.is_closed_manifold());
  EXPECT_EQ(t.num_components, 1u);
  EXPECT_EQ(t.euler_characteristic, 2);
  EXPECT_EQ(t.genus(), 0);
}

TEST(Topology, TorusAndCubeHaveGenusOneInAll) {
  TriMesh both = torus(5, 4);
  append_moved(both, test::unit_cube_surface(), {5, 0, 0});
  const auto t = compute_topology(both);
  EXPECT_TRUE(t.is_closed_manifold());
  EXPECT_EQ(t.num_components, 2u);
  EXPECT_EQ(t.genus(), 1);
  const auto component = compute_components(both);
  EXPECT_EQ(component[TriId(0)], 0);
  EXPECT_EQ(component[TriId(both.num_tris() - 1)], 1);
}

TEST(Topology, CountsBoundaryEdgesOfAnOpenCube) {
  TriMesh open = test::unit_cube_surface();
  open.tris.resize(10);
  EXPECT_EQ(compute_topology(open).num_boundary_edges, 4u);
  EXPECT_FALSE(compute_topology(open).is_closed_manifold());
}

TEST(Topology, AnOrientedCycleIsBalancedAlongEveryEdge) {
  TriMesh cube = test::unit_cube_surface();
  EXPECT_TRUE(is_oriented_cycle(cube));
  TriMesh twice = cube;
  for (const auto& tri : cube.tris) twice.tris.push_back(tri);
  EXPECT_TRUE(is_oriented_cycle(twice));  // though four triangles meet at each edge
  TriMesh flipped = cube;
  std::swap(flipped.tris[TriId(3)][0], flipped.tris[TriId(3)][1]);
  EXPECT_FALSE(is_oriented_cycle(flipped));
  cube.tris.resize(11);
  EXPECT_FALSE(is_oriented_cycle(cube));
}

TEST(Topology, FindsAVertexSharedByTwoFans) {
  TriMesh cubes = test::unit_cube_surface();
  append_moved(cubes, test::unit_cube_surface(), {1, 1, 1});
  EXPECT_EQ(compute_topology(cubes).num_nonmanifold_verts, 0u);
  for (auto& t : cubes.tris)
    for (VertId& v : t)
      if (v == VertId(8)) v = VertId(7);  // the corner where they touch
  const auto t = compute_topology(cubes);
  EXPECT_EQ(t.num_nonmanifold_verts, 1u);
  EXPECT_EQ(t.num_nonmanifold_edges, 0u);
  EXPECT_EQ(t.num_components, 2u);
}

TEST(Topology, FindsAnEdgeOfFourTriangles) {
  TriMesh cubes = test::unit_cube_surface();
  append_moved(cubes, test::unit_cube_surface(), {1, 1, 0});
  for (auto& t : cubes.tris)
    for (VertId& v : t) {
      if (v == VertId(8)) v = VertId(3);
      if (v == VertId(12)) v = VertId(7);
    }
  const auto t = compute_topology(cubes);
  EXPECT_EQ(t.num_nonmanifold_edges, 1u);
  EXPECT_EQ(t.num_components, 1u);
  EXPECT_EQ(t.num_nonmanifold_verts, 0u);
}

}  // namespace
}  // namespace hexwright
