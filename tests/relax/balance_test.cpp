#include "relax/state/balance.h"

#include <gtest/gtest.h>

#include "hexwright/fit/carve.h"
#include "hexwright/quality/hex_quality.h"
#include "hexwright/quality/surface_distance.h"

#include "fit/fit_helpers.h"
#include "fit/sheets/pad_boundary.h"
#include "relax/passes/finish.h"
#include "relax/passes/sweep.h"
#include "relax/state/targets.h"

namespace hexwright {
namespace {

using namespace fitting;
using namespace relax;

// A mesh whose boundary vertices are on the surface.
FitState fitted_to(const SurfaceTree& surface, double h) {
  const HexMesh grid = test::grid_around(surface.box(), h);
  FitState state(extract_hexes(grid, carve(grid, surface, {}, {}).is_kept));
  EXPECT_TRUE(pad_boundary(state));
  run_schedule(state, {surface, nullptr},
               {{0, 1, 0}, geometric_weights(1, 1e5, 10), 2, 0.03, false}, {});
  snap_to_targets(state, {surface, nullptr}, 0.2);
  return state;
}

void balance_and_snap(FitState& state, const SurfaceTree& surface) {
  const FitTarget target{surface, nullptr};
  update_targets(state, target, 0);
  balance_offsets(state, target);
  snap_to_targets(state, target, 0.2);
}

// Mean over the boundary quads' centres of their distance outwards from the unit sphere.
double mean_height_of_centers(const FitState& state) {
  double sum = 0;
  for (const auto& quad : state.quads) {
    Vec3 center;
    for (VertId v : quad) center += 0.25 * state.mesh.positions[v];
    sum += norm(center) - 1;
  }
  return sum / static_cast<double>(state.quads.size());
}

TEST(Balance, SpreadsTheSagOfASphereOverBothSides) {
  const SurfaceTree sphere(test::welded(test::unit_sphere_surface(5)));
  FitState state = fitted_to(sphere, 0.25);
  const double before = mean_height_of_centers(state);
  const SurfaceDistance far = measure_distance(state.mesh, sphere, {});
  balance_and_snap(state, sphere);
  const SurfaceDistance near = measure_distance(state.mesh, sphere, {});
  EXPECT_LT(before, -0.003);
  // A square over a paraboloid sags by s at its centre and by 2/3 s in the mean, so that the best
  // fit leaves a third of s there.
  EXPECT_NEAR(mean_height_of_centers(state), before / 3, 0.1 * std::abs(before));
  EXPECT_LT(near.mean_two_way(), 0.5 * far.mean_two_way());
  EXPECT_LT(near.max_two_way(), 0.8 * far.max_two_way());
  EXPECT_GT(summarize_quality(state.mesh).min_scaled_jacobian, 0.2);
}

TEST(Balance, LeavesPlanesAlone) {
  const SurfaceTree cube(test::unit_cube_surface());
  HexMesh mesh = test::box_hex_mesh(5, 5, 5);
  for (Vec3& p : mesh.positions) p = 0.2 * p;
  FitState state(mesh);
  balance_and_snap(state, cube);
  for (VertId v : state.kind.ids()) {
    EXPECT_NEAR(state.offset[v], 0, 1e-12);
    EXPECT_LT(distance(state.mesh.positions[v], mesh.positions[v]), 1e-12);
  }
}

TEST(Balance, MovesSurfaceVerticesOnlyAndWithinItsLimit) {
  const SurfaceTree sphere(test::welded(test::unit_sphere_surface(4)));
  FitState state = fitted_to(sphere, 0.5);
  VertId on_curve;
  for (VertId v : state.kind.ids())
    if (state.is_boundary(v)) on_curve = v;
  state.kind[on_curve] = VertKind::Curve;
  update_targets(state, {sphere, nullptr}, 0);
  const BalanceOptions options{0.01, 5};
  balance_offsets(state, {sphere, nullptr}, options);
  EXPECT_EQ(state.offset[on_curve], 0);
  int num_limited = 0;
  for (VertId v : state.kind.ids()) {
    EXPECT_TRUE(state.is_boundary(v) || state.offset[v] == 0);
    EXPECT_LE(std::abs(state.offset[v]), options.max_offset * state.size[v] * (1 + 1e-12));
    num_limited += state.offset[v] == options.max_offset * state.size[v];
  }
  EXPECT_GT(num_limited, 10);  // the limit is what held them
}

// The offsets are a property of the surface and the quads: once there, the vertices stay.
TEST(Balance, IsAFixedPoint) {
  const SurfaceTree torus(test::torus_surface(1, 0.4, 80, 40));
  FitState state = fitted_to(torus, 0.15);
  for (int round = 0; round < 3; ++round) balance_and_snap(state, torus);
  const auto offset = state.offset;
  const auto positions = state.mesh.positions;
  balance_and_snap(state, torus);
  for (VertId v : state.kind.ids()) {
    EXPECT_NEAR(state.offset[v], offset[v], 0.005 * state.size[v]);
    EXPECT_LT(distance(state.mesh.positions[v], positions[v]), 0.005 * state.size[v]);
  }
}

}  // namespace
}  // namespace hexwright
