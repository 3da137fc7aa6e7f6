// The mesh depends on the surface alone: not on the order of its vertices and triangles, nor on
// which way up it stands.
#include <algorithm>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "hexwright/geometry/rotation.h"
#include "hexwright/io/surface_io.h"
#include "hexwright/pipeline/mesh_surface.h"

#include "helpers.h"

namespace hexwright {
namespace {

TriMesh turned(TriMesh surface, const Rotation& turn) {
  for (Vec3& p : surface.positions) p = turn.apply(p);
  return surface;
}

/// Vertices renumbered, triangles reordered and begun with another corner.
TriMesh shuffled(const TriMesh& surface) {
  std::mt19937 rng(5);
  std::vector<VertId> old_to_new;
  for (VertId v : surface.positions.ids()) old_to_new.push_back(v);
  std::shuffle(old_to_new.begin(), old_to_new.end(), rng);
  TriMesh result = surface;
  for (VertId v : surface.positions.ids())
    result.positions[old_to_new[v.index()]] = surface.positions[v];
  std::vector<std::array<VertId, 3>> tris = surface.tris.raw();
  for (auto& tri : tris) {
    for (VertId& v : tri) v = old_to_new[v.index()];
    std::rotate(tri.begin(), tri.begin() + rng() % 3, tri.end());
  }
  std::shuffle(tris.begin(), tris.end(), rng);
  for (TriId t : result.tris.ids()) result.tris[t] = tris[t.index()];
  return result;
}

/// Coarse, so that ten models take seconds; a round of the loop stays, as it amplifies differences.
MeshResult coarse_mesh(const TriMesh& surface) {
  MeshOptions options;
  options.sizing.tolerance = 0.02;
  options.max_rounds = 1;
  return mesh_surface(surface, options, {});
}

void expect_same(const MeshResult& a, const MeshResult& b, const Rotation& turn) {
  EXPECT_EQ(a.rounds.size(), b.rounds.size());
  ASSERT_EQ(a.mesh.num_hexes(), b.mesh.num_hexes());
  EXPECT_EQ(a.mesh.hexes.raw(), b.mesh.hexes.raw());
  const double tolerance = 1e-12 * bounding_box(a.mesh).diagonal();
  for (VertId v : a.mesh.positions.ids())
    ASSERT_LE(distance(turn.apply(a.mesh.positions[v]), b.mesh.positions[v]), tolerance);
}

class OrderAndPose : public ::testing::TestWithParam<const char*> {
 protected:
  void check(const TriMesh& surface) {
    const MeshResult given = coarse_mesh(surface);
    const Rotation upright{{Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}};
    const Rotation upside_down{{Vec3{0, 0, -1}, Vec3{0, -1, 0}, Vec3{-1, 0, 0}}};
    expect_same(given, coarse_mesh(turned(surface, upright)), upright);
    expect_same(given, coarse_mesh(shuffled(turned(surface, upside_down))), upside_down);
  }
};

class BundledOrderAndPose : public OrderAndPose {};
TEST_P(BundledOrderAndPose, ChangeNothing) {
  check(read_surface(test::bundled(std::string("models/") + GetParam())).mesh);
}
INSTANTIATE_TEST_SUITE_P(Models, BundledOrderAndPose,
                         ::testing::Values("20mm-xyz-cube.stl", "3holes.obj",
                                           "cube_minus_sphere.obj", "plate_holes.stl",
                                           "spot_low_resolution.obj"));

class SharedOrderAndPose : public OrderAndPose {};
TEST_P(SharedOrderAndPose, ChangeNothing) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  check(read_surface(test::shared_dir() / "data/models" / GetParam()).mesh);
}
INSTANTIATE_TEST_SUITE_P(Models, SharedOrderAndPose,
                         ::testing::Values("anchor.off", "bone.obj", "fandisk.off", "joint.off",
                                           "building_wtc2.obj"));

}  // namespace
}  // namespace hexwright
