// Corners that are off by a little are taken just within the tolerance.
#include <gtest/gtest.h>

#include "hexwright/quality/hex_quality.h"

#include "helpers.h"
#include "relax/passes/finish.h"
#include "relax/state/fit_state.h"

namespace hexwright {
namespace {

using namespace relax;

/// A block of unit hexes whose vertex at the origin is a corner with a feature point elsewhere.
FitState block_with_corner_at(const Vec3& feature_point) {
  FitState state(test::box_hex_mesh(2, 2, 2));
  for (VertId v : state.kind.ids()) state.target[v] = state.mesh.positions[v];
  state.kind[VertId(0)] = VertKind::Corner;
  state.target[VertId(0)] = feature_point;
  return state;
}

double miss(const FitState& state) {
  return distance(state.mesh.positions[VertId(0)], state.target[VertId(0)]);
}

TEST(MeetCorners, MovesNoFartherThanTheToleranceAsks) {
  FitState state = block_with_corner_at({-0.1, -0.05, 0.02});
  const double before = miss(state), tolerance = 0.01;
  ASSERT_EQ(state.mesh.positions[VertId(0)], (Vec3{0, 0, 0}));
  EXPECT_EQ(meet_corners(state, tolerance, 0.2), 1u);
  EXPECT_NEAR(miss(state), tolerance, 1e-12);
  EXPECT_NEAR(norm(state.mesh.positions[VertId(0)]), before - tolerance, 1e-12);
  EXPECT_EQ(meet_corners(state, 1.001 * tolerance, 0.2), 0u);  // near enough
}

TEST(MeetCorners, StaysWhereQualityWouldSuffer) {
  for (const Vec3& inside : {Vec3{0.9, 0.9, 0.9}, Vec3{3, 3, 3}}) {
    FitState state = block_with_corner_at(inside);
    EXPECT_EQ(meet_corners(state, 0.01, 0.2), 0u);
    EXPECT_EQ(state.mesh.positions[VertId(0)], (Vec3{0, 0, 0}));
  }
  FitState state = block_with_corner_at({0.3, 0.3, 0.3});
  EXPECT_EQ(meet_corners(state, 0.01, 0.9), 0u);
  EXPECT_EQ(meet_corners(state, 0.01, 0.2), 1u);
  for (double quality : compute_scaled_jacobians(state.mesh)) EXPECT_GE(quality, 0.2);
}

TEST(MeetCorners, LeavesOtherVerticesAndHeldCornersAlone) {
  FitState state = block_with_corner_at({-0.1, 0, 0});
  state.move[VertId(0)] = MoveIn::Point;
  EXPECT_EQ(meet_corners(state, 0.01, 0.2), 0u);
  state.move[VertId(0)] = MoveIn::Space;
  state.kind[VertId(0)] = VertKind::Surface;
  EXPECT_EQ(meet_corners(state, 0.01, 0.2), 0u);
  EXPECT_EQ(state.mesh.positions[VertId(0)], (Vec3{0, 0, 0}));
}

}  // namespace
}  // namespace hexwright
