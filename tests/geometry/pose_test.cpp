#include "hexwright/geometry/pose.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "hexwright/geometry/similarity.h"
#include "hexwright/io/surface_io.h"

#include "fit/fit_helpers.h"
#include "helpers.h"
#include "solids.h"

namespace hexwright {
namespace {

using test::cylinder_surface;
using test::unit_cube_surface;
using test::unit_sphere_surface;

TriMesh stretched_cube(const Vec3& size) {
  TriMesh box = unit_cube_surface();
  for (Vec3& p : box.positions) p = {p.x * size.x, p.y * size.y, p.z * size.z};
  return box;
}

TriMesh rotated(TriMesh mesh, const Rotation& rotation) {
  for (Vec3& p : mesh.positions) p = rotation.apply(p);
  return mesh;
}

TEST(Pose, OfAPartAlongTheAxesKeepsEveryBit) {
  const TriMesh box = stretched_cube({1, 2, 3});
  EXPECT_TRUE(find_pose(box).is_identity());
  EXPECT_EQ(turn_surface(box, {}, 1e-6).positions.raw(), box.positions.raw());
}

TEST(Pose, OfRoundShapesIsTheGivenOne) {
  EXPECT_TRUE(find_pose(unit_sphere_surface(5)).is_identity());
  EXPECT_TRUE(find_pose(TriMesh{}).is_identity());
}

TEST(Pose, BringsATurnedBoxBackOntoItsPlanes) {
  std::mt19937 rng(7);
  for (int k = 0; k < 20; ++k) {
    const TriMesh box = test::randomly_rotated(stretched_cube({0.5, 0.8, 1}), rng);
    const Rotation pose = find_pose(box);
    const TriMesh turned = turn_surface(box, pose, 1e-6);
    // Six planes: two values per axis, exactly.
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (const Vec3& p : turned.positions) values.push_back(p[axis]);
      std::sort(values.begin(), values.end());
      values.erase(std::unique(values.begin(), values.end()), values.end());
      EXPECT_EQ(values.size(), 2u) << "box " << k << ", axis " << axis;
    }
  }
}

TEST(Pose, IsARotationThatTurnsAsLittleAsTheFrameAllows) {
  std::mt19937 rng(11);
  for (int k = 0; k < 20; ++k) {
    const Rotation pose = find_pose(test::randomly_rotated(stretched_cube({0.5, 0.8, 1}), rng));
    EXPECT_NEAR(det(pose.axes[0], pose.axes[1], pose.axes[2]), 1, 1e-12);
    double trace = 0;
    for (int a = 0; a < 3; ++a) {
      EXPECT_NEAR(norm(pose.axes[a]), 1, 1e-12);
      trace += pose.axes[a][a];
    }
    // The 24 rotations of the cube: none is farther from all of them than 62.8 degrees.
    EXPECT_GE(trace, 1 + 2 * std::cos(62.9 / 180 * std::numbers::pi));
    const Vec3 p{1, 2, 3};
    EXPECT_NEAR(distance(pose.apply_inverse(pose.apply(p)), p), 0, 1e-14);
  }
}

TEST(Pose, SeesASmallTurn) {
  for (const double degrees : {2.0, 20.0, 44.0}) {
    const double a = degrees / 180 * std::numbers::pi;
    const Rotation about_z{
        {Vec3{std::cos(a), -std::sin(a), 0}, Vec3{std::sin(a), std::cos(a), 0}, Vec3{0, 0, 1}}};
    const Rotation pose = find_pose(rotated(stretched_cube({1, 1, 0.1}), about_z));
    EXPECT_NEAR(pose.axes[0].x, std::cos(a), 1e-9) << degrees;
  }
}

TEST(CanonicalTurn, LaysThePartDownByItsExtents) {
  const TriMesh box = stretched_cube({1, 3, 2});
  const Rotation turn = find_canonical_turn(box);
  EXPECT_NEAR(det(turn.axes[0], turn.axes[1], turn.axes[2]), 1, 0);
  EXPECT_EQ(bounding_box(rotated(box, turn)).extent(), (Vec3{2, 1, 3}));
  EXPECT_TRUE(find_canonical_turn(TriMesh{}).is_identity());
}

TEST(CanonicalTurn, TellsTheEndsOfAConeApart) {
  TriMesh cone = cylinder_surface(0, 3, 0, 0.3, 24);
  for (Vec3& p : cone.positions) p = {p.x * (1 + p.z), p.y * (1 + p.z), p.z};
  TriMesh flipped = cone;
  for (Vec3& p : flipped.positions) p = {p.x, -p.y, -p.z};
  const TriMesh a = rotated(cone, find_canonical_turn(cone));
  const TriMesh b = rotated(flipped, find_canonical_turn(flipped));
  for (const Vec3& p : a.positions) {
    const auto is_near = [&](const Vec3& q) { return distance(p, q) < 1e-12; };
    EXPECT_TRUE(std::ranges::any_of(b.positions, is_near));
  }
  EXPECT_EQ(compose(find_canonical_turn(cone), {}).axes, find_canonical_turn(cone).axes);
}

TEST(Pose, FollowsTheFlatFacesOfACylinderOnly) {
  const double a = 0.5;
  const Rotation about_x{
      {Vec3{1, 0, 0}, Vec3{0, std::cos(a), -std::sin(a)}, Vec3{0, std::sin(a), std::cos(a)}}};
  const Rotation pose = find_pose(rotated(cylinder_surface(0, 1, 0, 0.3, 64), about_x));
  const Vec3 along = about_x.apply({0, 0, 1});
  EXPECT_NEAR(std::abs(dot(pose.axes[2], along)), 1, 1e-9);
}

}  // namespace
}  // namespace hexwright
