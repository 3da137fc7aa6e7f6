// The local passes after the fit: each mends what it is for, and nothing outside its surroundings.
#include <gtest/gtest.h>

#include "hexwright/quality/hex_quality.h"

#include "fit/boundary_fixtures.h"
#include "fit/fit_helpers.h"
#include "fit/sheets/pad_boundary.h"
#include "relax/passes/finish.h"
#include "relax/passes/pass.h"
#include "relax/passes/sweep.h"
#include "relax/state/proof.h"
#include "relax/state/targets.h"

namespace hexwright {
namespace {

using namespace fitting;
using namespace relax;

/// A padded ball, its boundary on the surface as far as the schedule takes it.
FitState fitted_ball(const SurfaceTree& sphere) {
  const HexMesh grid = test::grid_around(sphere.box(), 0.25);
  FitState state(extract_hexes(grid, carve(grid, sphere, {}, {}).is_kept));
  EXPECT_TRUE(pad_boundary(state));
  run_schedule(state, {sphere, nullptr}, {{0, 1, 0}, geometric_weights(1, 1e5, 8), 2, 0.03, false},
               {});
  update_targets(state, {sphere, nullptr}, 0);
  return state;
}

double worst_residual(const FitState& state) {
  double worst = 0;
  for (VertId v : state.kind.ids())
    if (!state.stars[v].empty()) worst = std::max(worst, state.residual(v));
  return worst;
}

/// Pulls a boundary vertex inwards by a share of its size, as far as its hexes stay good.
VertId dent(FitState& state, double share) {
  for (VertId v : state.kind.ids()) {
    if (!state.is_boundary(v)) continue;
    const Vec3 origin = state.mesh.positions[v];
    const Vec3 inside = origin * (1 - share * state.size[v] / norm(origin));
    const IdSpan<VertId, const Vec3> positions(state.mesh.positions);
    if (min_scaled_jacobian_around(inside, state.stars[v], positions) < 0.3) continue;
    state.mesh.positions[v] = inside;
    return v;
  }
  return {};
}

std::vector<char> rings_around(const FitState& state, VertId v, int rings) {
  std::vector<char> is_near(state.num_verts(), 0);
  is_near[v.index()] = 1;
  grow_vert_set(state, is_near, rings);
  return is_near;
}

class FinishPasses : public ::testing::Test {
 protected:
  SurfaceTree sphere{test::welded(test::unit_sphere_surface(4))};
  FitTarget target{sphere, nullptr};
};

TEST_F(FinishPasses, GrowTakesInOneRingOfHexNeighboursPerStep) {
  const FitState state(test::box_hex_mesh(5, 5, 5));
  const auto& p = state.mesh.positions;
  for (VertId v : p.ids()) {
    if (v.index() % 17 != 0) continue;
    for (int rings = 0; rings < 3; ++rings) {
      const auto is_near = rings_around(state, v, rings);
      for (VertId u : p.ids()) {
        const Vec3 d = p[u] - p[v];
        const double way = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        EXPECT_EQ(is_near[u.index()] != 0, way < rings + 0.5);
      }
    }
  }
}

TEST_F(FinishPasses, RefitBringsAStuckVertexBackAndTouchesNothingElse) {
  FitState state = fitted_ball(sphere);
  run(kRefit, state, target, {});
  update_targets(state, target, 0);
  const FitState before = state;
  const VertId v = dent(state, 0.3);
  ASSERT_TRUE(v.is_valid());
  update_targets(state, target, 0);
  ASSERT_GT(state.residual(v), 0.2);
  run(kRefit, state, target, {});
  update_targets(state, target, 0);
  EXPECT_LT(state.residual(v), kRefit.limit);
  EXPECT_GT(summarize_quality(state.mesh).min_scaled_jacobian, 0);
  const auto is_near = rings_around(state, v, kRefit.rings);
  std::size_t num_far = 0;
  for (VertId u : state.kind.ids()) {
    if (is_near[u.index()]) continue;
    ++num_far;
    EXPECT_EQ(state.mesh.positions[u], before.mesh.positions[u]);
  }
  EXPECT_GT(num_far, 100u);
}

TEST_F(FinishPasses, RefitLeavesAMeshAloneThatHasArrived) {
  FitState state = fitted_ball(sphere);
  const auto before = state.mesh.positions;
  Pass pass = kRefit;
  pass.limit = 1.01 * worst_residual(state);
  EXPECT_TRUE(run(pass, state, target, {}));
  EXPECT_EQ(state.mesh.positions, before);
}

TEST_F(FinishPasses, PolishRaisesPoorHexesAndTouchesNothingElse) {
  FitState state = fitted_ball(sphere);
  run(kPolish, state, target, {});
  ASSERT_GT(summarize_quality(state.mesh).min_scaled_jacobian, kPolish.limit);
  const FitState before = state;
  // An interior vertex most of the way to a neighbour.
  VertId moved;
  for (VertId v : state.kind.ids()) {
    if (state.is_boundary(v) || state.stars[v].empty()) continue;
    const Vec3 origin = state.mesh.positions[v];
    const VertId neighbor = state.stars[v][0][0];
    state.mesh.positions[v] = origin + 0.75 * (state.mesh.positions[neighbor] - origin);
    const double poor = min_scaled_jacobian_around(
        state.mesh.positions[v], state.stars[v], IdSpan<VertId, const Vec3>(state.mesh.positions));
    if (poor > 0 && poor < kPolish.limit) {
      moved = v;
      break;
    }
    state.mesh.positions[v] = origin;
  }
  ASSERT_TRUE(moved.is_valid());
  EXPECT_TRUE(run(kPolish, state, target, {}));
  EXPECT_GE(summarize_quality(state.mesh).min_scaled_jacobian, kPolish.limit);
  // Poor hexes are around the vertex; one ring more is worked on in each round.
  const auto is_near = rings_around(state, moved, 1 + kPolish.max_rounds);
  for (VertId u : state.kind.ids())
    if (!is_near[u.index()]) {
      EXPECT_EQ(state.mesh.positions[u], before.mesh.positions[u]);
    }
}

// The middle one of 27 hexes is made small, so that it can be bent; few of those bent at random
// have positive corners and no proof.
TEST_F(FinishPasses, MendUnprovenProvesBentHexes) {
  const HexMesh block = test::box_hex_mesh(3, 3, 3);
  const SurfaceTree box(test::surface_of(block));
  constexpr double kEdge = 0.4;
  std::mt19937 rng(21);
  std::uniform_real_distribution<double> offset(-0.5 * kEdge, 0.5 * kEdge);
  int mended = 0;
  for (int trial = 0; trial < 20000 && mended < 1; ++trial) {
    FitState state(block);
    for (VertId v : state.kind.ids()) {
      Vec3& p = state.mesh.positions[v];
      if (!state.is_boundary(v))
        p = Vec3{1.5, 1.5, 1.5} + kEdge * (p - Vec3{1.5, 1.5, 1.5}) +
            Vec3{offset(rng), offset(rng), offset(rng)};
    }
    const double least = summarize_quality(state.mesh).min_scaled_jacobian;
    if (!(least > 0) || find_unproven(state.mesh).empty()) continue;
    EXPECT_TRUE(mend_unproven(state, {box, nullptr}, 0, {}).empty());
    EXPECT_TRUE(find_unproven(state.mesh).empty());
    EXPECT_GE(summarize_quality(state.mesh).min_scaled_jacobian, std::min(least, 0.2));
    ++mended;
  }
  EXPECT_EQ(mended, 1);
}

TEST_F(FinishPasses, MendUnprovenLeavesProvenMeshesAlone) {
  FitState state = fitted_ball(sphere);
  ASSERT_TRUE(find_unproven(state.mesh).empty());
  const auto before = state.mesh.positions;
  EXPECT_TRUE(mend_unproven(state, target, 0, {}).empty());
  EXPECT_EQ(state.mesh.positions, before);
}

/// A hex of an engraved letter: two corners and two points of one crease on top, which have slid
/// past each other. All corners are positive, the Jacobian in the middle of an edge is not.
HexMesh hex_on_a_crease() {
  HexMesh mesh;
  mesh.positions = {{-39.102, -3.69, -16.324},  {-36.79, -3.594, -18.331},
                    {-36.202, -3.426, -17.68},  {-38.975, -4.023, -15.932},
                    {-39.567, -4.408, -17.308}, {-36.232, -4.913, -17.382},
                    {-36.232, -4.408, -17.308}, {-39.549, -4.525, -17.313}};
  std::array<VertId, 8> hex;
  for (int k = 0; k < 8; ++k) hex[static_cast<std::size_t>(k)] = VertId(k);
  mesh.hexes.push_back(hex);
  return mesh;
}

TEST_F(FinishPasses, FreeUnprovenLeavesTheSurfaceAsFarAsItIsAllowed) {
  const HexMesh mesh = hex_on_a_crease();
  const SurfaceTree surface(test::surface_of(mesh));
  const std::vector<HexId> unproven = find_unproven(mesh);
  ASSERT_EQ(unproven, std::vector<HexId>{HexId(0)});
  ASSERT_GT(scaled_jacobian(mesh.corners(HexId(0))), 0);
  for (const double slack : {0.001, 0.7}) {
    FitState state(mesh);
    update_targets(state, {surface, nullptr}, 0);
    const double floor = 0.1;
    const bool is_free = slack > 0.1;
    EXPECT_EQ(free_unproven(state, unproven, slack, {&floor, 1}).empty(), is_free) << slack;
    EXPECT_EQ(find_unproven(state.mesh).empty(), is_free) << slack;
    EXPECT_EQ(state.mesh.positions == mesh.positions, !is_free) << slack;
    for (VertId v : mesh.positions.ids())
      EXPECT_LE(distance(state.mesh.positions[v], mesh.positions[v]), slack + 1e-12);
    EXPECT_GE(scaled_jacobian(state.mesh.corners(HexId(0))),
              std::min(0.1, scaled_jacobian(mesh.corners(HexId(0)))));
  }
}

/// What a vertex is off its target already is not free a second time, whichever way it goes.
TEST_F(FinishPasses, FreeUnprovenCountsWhatWasOffTheSurfaceBefore) {
  const HexMesh mesh = hex_on_a_crease();
  const SurfaceTree surface(test::surface_of(mesh));
  constexpr double kSlack = 0.7;
  std::size_t num_moved = 0;
  for (const double off : {-0.4, -0.2, 0.2, 0.4}) {
    FitState state(mesh);
    update_targets(state, {surface, nullptr}, 0);
    for (VertId v : state.kind.ids()) state.target[v] += off * state.direction[v];
    const double floor = 0.1;
    free_unproven(state, find_unproven(mesh), kSlack, {&floor, 1});
    num_moved += state.mesh.positions != mesh.positions;
    for (VertId v : mesh.positions.ids()) {
      EXPECT_LE(distance(state.mesh.positions[v], mesh.positions[v]),
                kSlack - std::abs(off) + 1e-12);
      EXPECT_LE(state.residual(v) * state.size[v], kSlack + 1e-12);
    }
  }
  EXPECT_GT(num_moved, 0u);
}

TEST_F(FinishPasses, MendUnprovenLeavesCornersWhereNothingElseHelps) {
  const HexMesh mesh = hex_on_a_crease();
  const TriMesh boundary = test::surface_of(mesh);
  const SurfaceTree surface(boundary);
  const FeatureGraph features;
  const FitTarget corners = {surface, &features};
  for (const double slack : {0.0, 0.7}) {
    FitState state(mesh);
    for (VertId v : state.kind.ids()) {
      state.kind[v] = VertKind::Corner;
      const auto& points = boundary.positions.raw();
      const auto at = std::find(points.begin(), points.end(), mesh.positions[v]);
      state.feature_point[v] = VertId(static_cast<std::size_t>(at - points.begin()));
    }
    update_targets(state, corners, 0);
    const bool is_free = slack > 0;
    EXPECT_EQ(mend_unproven(state, corners, slack, {}).empty(), is_free) << slack;
    EXPECT_EQ(find_unproven(state.mesh).empty(), is_free) << slack;
  }
}

TEST_F(FinishPasses, SnapGoesAsFarAsQualityAllows) {
  FitState state = fitted_ball(sphere);
  const VertId v = dent(state, 0.25);
  ASSERT_TRUE(v.is_valid());
  update_targets(state, target, 0);
  const double before = state.residual(v);
  std::vector<char> only(state.num_verts(), 0);
  only[v.index()] = 1;
  const auto positions = state.mesh.positions;
  snap_to_targets(state, target, 0.2, only);
  EXPECT_LT(state.residual(v), 0.1 * before);
  for (VertId u : state.kind.ids())
    if (u != v) {
      EXPECT_EQ(state.mesh.positions[u], positions[u]);
    }
}

}  // namespace
}  // namespace hexwright
