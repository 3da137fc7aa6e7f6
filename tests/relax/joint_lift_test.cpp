// All vertices of a region at once: the energy's steps, and what the lift promises of a whole mesh.
#include <random>

#include <gtest/gtest.h>

#include "hexwright/base/parallel.h"
#include "hexwright/fit/fit.h"
#include "hexwright/geometry/prepare_surface.h"
#include "hexwright/geometry/similarity.h"
#include "hexwright/io/surface_io.h"
#include "hexwright/quality/hex_quality.h"
#include "hexwright/quality/surface_distance.h"

#include "fit/fit_helpers.h"
#include "helpers.h"
#include "relax/joint/energy.h"
#include "relax/joint/region.h"
#include "relax/joint/volume_budget.h"
#include "relax/state/proof.h"

namespace hexwright {
namespace {

using namespace relax;

/// A jittered block of hexes whose inner vertices are movable.
struct Block {
  explicit Block(unsigned seed) : state(test::box_hex_mesh(4, 4, 4)) {
    std::mt19937 rng(seed);
    std::uniform_real_distribution<double> jitter(-0.3, 0.3);
    const double h = distance(state.mesh.positions[state.mesh.hexes[HexId(0)][0]],
                              state.mesh.positions[state.mesh.hexes[HexId(0)][1]]);
    std::vector<VertId> movable;
    std::vector<HexId> hexes;
    for (VertId v : state.kind.ids()) {
      if (state.is_boundary(v)) continue;
      movable.push_back(v);
      state.mesh.positions[v] += h * Vec3{jitter(rng), jitter(rng), jitter(rng)};
    }
    for (HexId hex : state.mesh.hexes.ids()) hexes.push_back(hex);
    region.emplace(state, movable, hexes);
    for (VertId v : region->verts()) positions.push_back(state.mesh.positions[v]);
    for (VertId v : movable) freedom.push_back({VertKind::Interior, {}, {}, 0, state.size[v]});
  }

  FitState state;
  std::optional<JointRegion> region;
  std::vector<Vec3> positions;
  std::vector<JointFreedom> freedom;
};

constexpr double kSharpness = 25;

TEST(JointEnergy, IsTheLeastScaledJacobianAsItGetsSharp) {
  Block block(3);
  JointEnergy energy(block.region->shape());
  const auto quality = compute_scaled_jacobians(block.state.mesh);
  const double least = *std::min_element(quality.begin(), quality.end());
  EXPECT_DOUBLE_EQ(energy.evaluate(block.positions, block.freedom, kSharpness).least, least);
  EXPECT_NEAR(energy.evaluate(block.positions, block.freedom, 1e5).energy, -least, 1e-3);
}

// With much damping the step is the gradient's, which differences of the energy give too.
TEST(JointEnergy, StepsAgainstItsGradient) {
  Block block(4);
  JointEnergy energy(block.region->shape());
  const auto at = [&](const std::vector<Vec3>& positions) {
    return energy.evaluate(positions, block.freedom, kSharpness).energy;
  };
  constexpr double kDelta = 1e-6;
  std::vector<Vec3> gradient(block.freedom.size());
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      auto moved = block.positions;
      moved[i][axis] += kDelta;
      gradient[i][axis] = at(moved);
      moved[i][axis] -= 2 * kDelta;
      gradient[i][axis] = (gradient[i][axis] - at(moved)) / (2 * kDelta);
    }
  }
  at(block.positions);
  energy.linearize(block.positions, block.freedom, kSharpness);
  const auto step = energy.step(block.freedom, 1e6, 1);
  double along = 0, of_step = 0, of_gradient = 0;
  for (std::size_t i = 0; i < step.size(); ++i) {
    along -= dot(step[i], gradient[i]);
    of_step += norm_sq(step[i]);
    of_gradient += norm_sq(gradient[i]);
  }
  EXPECT_GT(along / std::sqrt(of_step * of_gradient), 0.999);
}

TEST(JointEnergy, DescendsByGaussNewtonSteps) {
  for (unsigned seed = 1; seed < 6; ++seed) {
    Block block(seed);
    JointEnergy energy(block.region->shape());
    const JointValue first = energy.evaluate(block.positions, block.freedom, kSharpness);
    energy.linearize(block.positions, block.freedom, kSharpness);
    const auto step = energy.step(block.freedom, 1e-1, 0.25);
    for (std::size_t i = 0; i < step.size(); ++i) {
      EXPECT_LE(norm(step[i]), 0.25 * block.freedom[i].size * (1 + 1e-12));
      block.positions[i] += step[i];
    }
    const JointValue second = energy.evaluate(block.positions, block.freedom, kSharpness);
    EXPECT_LT(second.energy, first.energy) << "seed " << seed;
    EXPECT_GT(second.least, first.least) << "seed " << seed;
  }
}

TEST(JointEnergy, KeepsVertsWithoutSlackOnWhatTheyAreAttachedTo) {
  Block block(7);
  const Vec3 axis = normalized(Vec3{1, 2, 3});
  block.freedom[0].kind = VertKind::Surface;
  block.freedom[1].kind = VertKind::Curve;
  block.freedom[2].kind = VertKind::Corner;
  for (std::size_t i = 0; i < 3; ++i) block.freedom[i].axis = axis;
  JointEnergy energy(block.region->shape());
  energy.evaluate(block.positions, block.freedom, kSharpness);
  energy.linearize(block.positions, block.freedom, kSharpness);
  const auto step = energy.step(block.freedom, 1e-2, 1);
  EXPECT_GT(norm(step[0]), 0);
  EXPECT_NEAR(dot(step[0], axis), 0, 1e-9 * norm(step[0]));
  EXPECT_NEAR(norm(cross(step[1], axis)), 0, 1e-9 * norm(step[1]));
  EXPECT_EQ(step[2], Vec3{});
}

TEST(VolumeBudget, ChangesAddUpAndThoseTheOtherWayGiveRoomBack) {
  VolumeBudget budget(1);
  EXPECT_TRUE(budget.spend(0.75));
  EXPECT_FALSE(budget.spend(0.5));
  EXPECT_TRUE(budget.spend(0.25));  // what did not fit is not counted
  EXPECT_TRUE(budget.spend(-1.75));
  EXPECT_FALSE(budget.spend(-0.5));
  EXPECT_TRUE(budget.spend(0.5));
  EXPECT_TRUE(budget.spend(1.25));  // just all of it
  EXPECT_FALSE(budget.spend(1e-9));
}

TEST(VolumeBudget, OfNothingTakesNoChangeAtAll) {
  VolumeBudget budget(0);
  EXPECT_FALSE(budget.spend(1e-300));
  EXPECT_FALSE(budget.spend(-1e-300));
  EXPECT_TRUE(budget.spend(0));
}

/// More than any part has by itself.
FitOptions high_goal() {
  FitOptions options;
  options.lift_goal = 0.6;
  return options;
}

struct Lifted {
  FitResult before, after;
};

/// A plate with holes, turned against a coarse grid, has poor hexes along its rims.
TriMesh turned_plate(std::mt19937& rng) {
  TriMesh plate =
      prepare_surface(read_surface(test::bundled("models/plate_holes.stl")).mesh, {}).mesh;
  return test::randomly_rotated(to_unit(plate, compute_unit_frame(plate)), rng);
}

/// Cells are a share 1 / `cells` of the diagonal.
Lifted lift_coarse(const Target& target, const FitOptions& options, double cells = 36) {
  const double h = target.diagonal() / cells;
  Lifted result;
  result.before = fit_unlifted(test::grid_around(target.tree.box(), h), target, options, {});
  EXPECT_NE(result.before.memory, nullptr);
  if (result.before.memory) result.after = lift_fit(*result.before.memory, target, options, {});
  return result;
}

double least(const FitResult& result) { return summarize_quality(result.mesh).min_scaled_jacobian; }

TEST(JointLift, RaisesTheLeastWithinTheTolerance) {
  std::mt19937 rng(5);
  double sum_before = 0, sum_after = 0;
  const FitOptions options = high_goal();
  for (int trial = 0; trial < 2; ++trial) {
    const Target target = wrap_target(turned_plate(rng));
    const Lifted lifted = lift_coarse(target, options);
    sum_before += least(lifted.before);
    sum_after += least(lifted.after);
    EXPECT_GE(least(lifted.after), least(lifted.before) - 1e-9) << "trial " << trial;
    EXPECT_EQ(lifted.after.mesh.hexes, lifted.before.mesh.hexes);
    EXPECT_LE(lifted.after.report.unproven.size(), lifted.before.report.unproven.size());
    const double before = measure_distance(lifted.before.mesh, target.tree, {}).max_two_way();
    const double after = measure_distance(lifted.after.mesh, target.tree, {}).max_two_way();
    EXPECT_LE(after, std::max(options.tolerance, 1.05 * before)) << "trial " << trial;
  }
  EXPECT_GT(sum_after, sum_before + 2 * 0.05);
}

// A thin plate has room on both sides: left to themselves, its poor hexes would make it thicker.
TEST(JointLift, KeepsTheVolume) {
  std::mt19937 rng(6);
  const Target target = wrap_target(turned_plate(rng));
  FitOptions options = high_goal();
  options.tolerance = 0.03;  // so wide that the volume alone holds the surface
  const Lifted lifted = lift_coarse(target, options, 30);
  const double before = summarize_quality(lifted.before.mesh).total_volume;
  const double after = summarize_quality(lifted.after.mesh).total_volume;
  EXPECT_GT(least(lifted.after), least(lifted.before));
  EXPECT_LT(std::abs(after / before - 1), 0.003);
}

// With so little room its first passes cost more than it brings.
TEST(JointLift, TakesBackWhatLowersTheLeast) {
  std::mt19937 rng(6);
  const Target target = wrap_target(turned_plate(rng));
  FitOptions options = high_goal();
  options.tolerance = 0.005;
  const Lifted lifted = lift_coarse(target, options, 24);
  EXPECT_GE(least(lifted.after), least(lifted.before));
  EXPECT_EQ(lifted.after.mesh.positions, lifted.before.mesh.positions);
}

TEST(JointLift, IsTheSameForAnyNumberOfThreads) {
  std::mt19937 rng(5);
  const Target target = wrap_target(turned_plate(rng));
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return lift_coarse(target, high_goal()).after.mesh.positions;
  };
  const auto one = run(1);
  EXPECT_EQ(one, run(2));
  EXPECT_EQ(one, run(5));
}

TEST(JointLift, HasNothingToDoWhereTheGoalIsMetOrNoneIsSet) {
  const Target sphere = wrap_target(test::welded(test::unit_sphere_surface(4)));
  const HexMesh grid = test::grid_around(sphere.tree.box(), 0.12);
  EXPECT_EQ(fit_unlifted(grid, sphere, {}, {}).memory, nullptr);
  std::mt19937 rng(5);
  const Target plate = wrap_target(turned_plate(rng));
  FitOptions options;
  options.lift_goal = 0;
  const HexMesh coarse = test::grid_around(plate.tree.box(), plate.diagonal() / 30);
  EXPECT_EQ(fit_unlifted(coarse, plate, options, {}).memory, nullptr);
  options = high_goal();
  EXPECT_NE(fit_unlifted(coarse, plate, options, {}).memory, nullptr);
  options.patch_verts = PatchVerts::OnSurface;
  EXPECT_EQ(fit_unlifted(coarse, plate, options, {}).memory, nullptr);
}

}  // namespace
}  // namespace hexwright
