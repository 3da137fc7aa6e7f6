// The lattice along a part's faces, whatever the part's pose.
#include <gtest/gtest.h>

#include "hexwright/pipeline/mesh_surface.h"
#include "hexwright/quality/judge.h"

#include "helpers.h"

namespace hexwright {
namespace {

TriMesh box_surface() {
  TriMesh box = test::unit_cube_surface();
  for (Vec3& p : box.positions) p = {4 * p.x, 3 * p.y, 2 * p.z};
  return box;
}

/// Turned about (1, 2, 3) and shifted.
Vec3 turned(const Vec3& p, double degrees) {
  const Vec3 k = normalized({1, 2, 3});
  const double a = degrees / 180 * std::numbers::pi;
  return p * std::cos(a) + cross(k, p) * std::sin(a) + k * (dot(k, p) * (1 - std::cos(a))) +
         Vec3{10, -20, 5};
}

class TurnedBox : public ::testing::TestWithParam<double> {};

TEST_P(TurnedBox, IsMeshedAsTheStraightOne) {
  const TriMesh straight = box_surface();
  TriMesh box = straight;
  for (Vec3& p : box.positions) p = turned(p, GetParam());
  const MeshResult expected = mesh_surface(straight, {}, {});
  const MeshResult result = mesh_surface(box, {}, {});
  EXPECT_TRUE(result.failures.empty());
  // The grid's cells stand along the pose's axes.
  const double h = result.grid.frame.root_size;
  Box3 grid_box, in_grid;
  for (const LatticeCoord& root : result.grid.roots)
    for (int d : {0, 1})
      grid_box.extend(Vec3{(root[0] + d) * h, (root[1] + d) * h, (root[2] + d) * h});
  for (const Vec3& p : box.positions)
    in_grid.extend(result.pose.apply(p - result.grid.frame.origin));
  EXPECT_TRUE(grid_box.contains(in_grid.lo) && grid_box.contains(in_grid.hi));
  EXPECT_EQ(result.mesh.num_hexes(), expected.mesh.num_hexes());
  EXPECT_NEAR(result.verdict.quality.min_scaled_jacobian,
              expected.verdict.quality.min_scaled_jacobian, 1e-3);
  // Measured where the user's surface is, by its own diagonal.
  const Verdict verdict = judge(result.mesh, box, {}, {}, {});
  EXPECT_LT(verdict.distance->max_two_way(), 1e-6);
  EXPECT_EQ(verdict.features->num_corners_recovered, 8u);
  EXPECT_NEAR(verdict.quality.total_volume, 24, 1e-6);
}
INSTANTIATE_TEST_SUITE_P(Placement, TurnedBox, ::testing::Values(5.0, 20.0, 30.0, 45.0, 100.0));

TEST(Placement, AsGivenLeavesTheLatticeAlongTheAxes) {
  TriMesh box = box_surface();
  for (Vec3& p : box.positions) p = turned(p, 30);
  MeshOptions options;
  options.target.placement = Placement::AsGiven;
  options.max_rounds = 0;
  const std::size_t num_given = mesh_surface(box, options, {}).mesh.num_hexes();
  options.target.placement = Placement::Faces;
  EXPECT_LT(mesh_surface(box, options, {}).mesh.num_hexes(), num_given);
}

TEST(Placement, LeavesTheBackgroundsBoxAlongTheAxes) {
  TriMesh box = box_surface();
  for (Vec3& p : box.positions) p = turned(p, 30);
  MeshOptions options;
  options.max_rounds = 0;
  options.fit.carve.side = Side::Both;
  const MeshResult result = mesh_surface(box, options, {});
  Box3 extent;
  for (const Vec3& p : result.mesh.positions) extent.extend(p);
  // An axis-aligned cube: its volume is that of its box.
  const Vec3 e = extent.extent();
  EXPECT_NEAR(result.verdict.quality.total_volume / (e.x * e.y * e.z), 1, 1e-6);
}

}  // namespace
}  // namespace hexwright
