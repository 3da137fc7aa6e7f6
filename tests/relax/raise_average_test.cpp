#include <gtest/gtest.h>

#include "hexwright/fit/carve.h"
#include "hexwright/quality/hex_quality.h"

#include "fit/fit_helpers.h"
#include "fit/sheets/pad_boundary.h"
#include "relax/passes/finish.h"
#include "relax/passes/sweep.h"
#include "relax/state/proof.h"
#include "relax/state/targets.h"

namespace hexwright {
namespace {

using namespace fitting;
using namespace relax;

FitState fitted_torus(const SurfaceTree& torus) {
  const HexMesh grid = test::grid_around(torus.box(), 0.16);
  FitState state(extract_hexes(grid, carve(grid, torus, {}, {}).is_kept));
  EXPECT_TRUE(pad_boundary(state));
  run_schedule(state, {torus, nullptr}, {{0, 1, 0}, geometric_weights(1, 1e5, 10), 2, 0.03, false},
               {});
  snap_to_targets(state, {torus, nullptr}, 0.2);
  return state;
}

TEST(RaiseAverage, KeepsTheLeastTheSurfaceAndTheProofs) {
  const SurfaceTree torus(test::torus_surface(1, 0.4, 60, 30));
  FitState state = fitted_torus(torus);
  const QualitySummary before = summarize_quality(state.mesh);
  const std::size_t unproven = find_unproven(state.mesh).size();
  AverageOptions options;
  options.floor = before.min_scaled_jacobian;
  for (int round = 0; round < 3; ++round) raise_average(state, {torus, nullptr}, options, {});
  const QualitySummary after = summarize_quality(state.mesh);
  EXPECT_GT(after.avg_scaled_jacobian, before.avg_scaled_jacobian + 0.01);
  EXPECT_GE(after.min_scaled_jacobian, before.min_scaled_jacobian - 1e-8);
  EXPECT_LE(find_unproven(state.mesh).size(), unproven);
  update_targets(state, {torus, nullptr}, 0);
  for (VertId v : state.kind.ids()) EXPECT_LT(state.residual(v), 0.02);
}

// What a regular grid loses by a jitter comes back but for the boundary's share.
TEST(RaiseAverage, StraightensAJitteredGrid) {
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> offset(-0.2, 0.2);
  HexMesh mesh = test::box_hex_mesh(6, 6, 6);
  FitState straight(mesh);
  for (VertId v : mesh.positions.ids())
    if (!straight.is_boundary(v)) mesh.positions[v] += {offset(rng), offset(rng), offset(rng)};
  FitState state(mesh);
  for (VertId v : state.kind.ids())
    if (state.is_boundary(v)) state.move[v] = MoveIn::Point;
  ASSERT_LT(summarize_quality(mesh).avg_scaled_jacobian, 0.9);
  for (int round = 0; round < 4; ++round) {
    state.mark_all_dirty();
    sweep_for_average(state, 0, {4, 8, 1e-4}, {});
  }
  EXPECT_GT(summarize_quality(state.mesh).min_scaled_jacobian, 0.999);
}

// The scaled Jacobian alone lets an edge vanish: all corners of a wedge can be good. Here the pull
// of a target close to a neighbour stands for it.
TEST(Sweep, LetsNoEdgeShrinkBelowItsFloor) {
  const VertId v(1 + 3 + 9), neighbor(2 + 3 + 9);  // of the 27 vertices the middle, and one along x
  const auto edge_after = [&](double edge_floor) {
    FitState state(test::box_hex_mesh(2, 2, 2));
    state.kind[v] = VertKind::Corner;
    state.target[v] = state.mesh.positions[neighbor] - Vec3{0.02, 0, 0};
    SweepOptions options{{0, 1, 0}, 1e9, 0.01};
    options.edge_floor = edge_floor;
    std::vector<char> only(state.num_verts(), 0);
    only[v.index()] = 1;
    const LocalSweep local(state, only);
    for (int s = 0; s < 20; ++s) local.run(state, options);
    return distance(state.mesh.positions[v], state.mesh.positions[neighbor]);
  };
  EXPECT_LT(edge_after(0), 0.05);
  EXPECT_GE(edge_after(0.15), 0.15);
  EXPECT_LT(edge_after(0.01), 0.05);  // longer edges may shrink
}

// Each round of weights and sweeps can only raise the softened average it maximises.
TEST(RaiseAverage, RaisesTheAverageInEveryRound) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> offset(-0.25, 0.25);
  HexMesh mesh = test::box_hex_mesh(4, 4, 4);
  for (Vec3& p : mesh.positions) p += {offset(rng), offset(rng), offset(rng)};
  FitState state(mesh);
  for (VertId v : state.kind.ids())
    if (state.is_boundary(v)) state.move[v] = MoveIn::Point;
  const double least = summarize_quality(mesh).min_scaled_jacobian;
  ASSERT_GT(least, 0);
  constexpr int kPower = 8;
  const auto soft_average = [&] {
    double sum = 0;
    for (HexId h : state.mesh.hexes.ids()) {
      double mean = 0;
      for (int lv = 0; lv < 8; ++lv)
        mean += std::pow(corner_scaled_jacobian(state.mesh.corners(h), lv), -2 * kPower) / 8;
      sum += std::pow(mean, -0.5 / kPower);
    }
    return sum / static_cast<double>(state.mesh.num_hexes());
  };
  double last = soft_average();
  for (int round = 0; round < 8; ++round) {
    state.mark_all_dirty();
    sweep_for_average(state, least, {1, kPower, 0.01}, {});
    const double now = soft_average();
    EXPECT_GE(now, last - 1e-12);
    last = now;
    EXPECT_GE(summarize_quality(state.mesh).min_scaled_jacobian, least - 1e-9);
  }
}

}  // namespace
}  // namespace hexwright
