// Which poor hexes call for finer cells, and what that brings.
#include "pipeline/loop/poor_hexes.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "hexwright/io/surface_io.h"
#include "hexwright/pipeline/mesh_surface.h"
#include "hexwright/quality/hex_quality.h"

#include "helpers.h"

namespace hexwright {
namespace {

constexpr double kGoal = 0.4;

/// A box of n hexes along x; those at its upper edge y = z = 1 are cut to a wedge: the boundary
/// faces there meet at the angle, in degrees.
HexMesh wedge(int n, double degrees) {
  HexMesh mesh = test::box_hex_mesh(n, 1, 1);
  const double half = 0.5 * (90 - degrees) * std::acos(-1.0) / 180;
  // The edge is the tip; both faces turn towards the diagonal by half of what lacks to 90 degrees.
  for (Vec3& p : mesh.positions) {
    if (p.y < 0.5 && p.z > 0.5) p.z -= std::tan(half);
    if (p.z < 0.5 && p.y > 0.5) p.y -= std::tan(half);
  }
  return mesh;
}

double least(const HexMesh& mesh) {
  const auto quality = compute_scaled_jacobians(mesh);
  return *std::min_element(quality.begin(), quality.end());
}

TEST(PoorHexes, AShearedHexIsAPlaceAtItsMiddle) {
  HexMesh mesh = test::box_hex_mesh(3, 3, 3);
  EXPECT_TRUE(find_poor_places(mesh, kGoal).empty());
  // An inner vertex next to another: the hexes that hold their edge are poor, and none other.
  const auto inner = [&](double x) {
    return std::ranges::find_if(mesh.positions, [&](const Vec3& p) {
      return norm(p - Vec3{x, 1, 1}) < 1e-12;
    });
  };
  const auto moved = inner(1);
  ASSERT_NE(moved, mesh.positions.end());
  *moved += Vec3{0, 0.9, 0.9};
  ASSERT_LT(least(mesh), kGoal);
  const std::vector<Vec3> places = find_poor_places(mesh, kGoal);
  const auto quality = compute_scaled_jacobians(mesh);
  EXPECT_EQ(places.size(), static_cast<std::size_t>(std::ranges::count_if(
                               quality.raw(), [](double q) { return q < kGoal; })));
  for (const Vec3& p : places) EXPECT_LT(norm(p - Vec3{1, 1.5, 1.5}), 1.5);
}

TEST(PoorHexes, AWedgeOfTheBoundaryIsNone) {
  const HexMesh mesh = wedge(2, 18);
  ASSERT_NEAR(least(mesh), std::sin(18 * std::acos(-1.0) / 180), 1e-9);
  EXPECT_TRUE(find_poor_places(mesh, kGoal).empty());
}

TEST(PoorHexes, ABoundaryPressedFlatIsOne) {
  // The faces meet at 175 degrees, which is no wedge but two faces on one plane.
  const HexMesh mesh = wedge(2, 175);
  ASSERT_LT(least(mesh), kGoal);
  EXPECT_EQ(find_poor_places(mesh, kGoal).size(), 2u);
}

TEST(PoorHexes, ARoundIsRefinedWhereItStaysPoor) {
  MeshOptions options;
  const TriMesh surface = read_surface(test::bundled("models/20mm-xyz-cube.stl")).mesh;
  const MeshResult result = mesh_surface(surface, options, {});
  const double goal = 0.8 * options.fit.lift_goal;
  ASSERT_GT(result.best_round, 0);
  const RoundRecord& best = result.rounds[static_cast<std::size_t>(result.best_round)];
  EXPECT_DOUBLE_EQ(best.min_scaled_jacobian, result.verdict.quality.min_scaled_jacobian);
  EXPECT_GE(best.min_scaled_jacobian, goal);
  // Without the last step it would have ended below.
  const RoundRecord& before = result.rounds[static_cast<std::size_t>(result.best_round) - 1];
  EXPECT_LT(before.min_scaled_jacobian, goal);
  EXPECT_LE(static_cast<double>(best.num_hexes), 1.1 * static_cast<double>(before.num_hexes));
  EXPECT_TRUE(result.failures.empty());
}

TEST(PoorHexes, WithoutRoundsNothingIsRefined) {
  MeshOptions options;
  options.max_rounds = 0;
  const TriMesh surface = read_surface(test::bundled("models/20mm-xyz-cube.stl")).mesh;
  const MeshResult result = mesh_surface(surface, options, {});
  EXPECT_EQ(result.rounds.size(), 1u);
  EXPECT_LT(result.verdict.quality.min_scaled_jacobian, 0.8 * options.fit.lift_goal);
}

}  // namespace
}  // namespace hexwright
