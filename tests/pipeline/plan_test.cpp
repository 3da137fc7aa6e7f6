// The plan: what each stage is asked for follows from the wishes and the surface alone.
#include "hexwright/pipeline/plan.h"

#include <limits>

#include <gtest/gtest.h>

#include "hexwright/pipeline/stages.h"

#include "helpers.h"
#include "pipeline/loop/budgets.h"

namespace hexwright {
namespace {

TriMesh open_cube() {
  TriMesh cube = test::unit_cube_surface();
  cube.tris.raw().pop_back();
  return cube;
}

TEST(Plan, TheJudgeSamplesCloserThanWhatItIsToFind) {
  const Target target = wrap_target(test::unit_cube_surface());
  MeshOptions wishes;
  wishes.sizing.tolerance = 0.001;
  const StagePlan stages = plan(wishes, target);
  EXPECT_DOUBLE_EQ(stages.judge.hot_threshold, wishes.refine_threshold * 0.001);
  EXPECT_LE(stages.judge.spacing, 1.5 * stages.judge.hot_threshold);
  EXPECT_EQ(stages.judge.quads, JudgedQuads::Boundary);
  wishes.fit.carve.side = Side::Outside;  // the box around it is no part of the surface
  EXPECT_EQ(plan(wishes, target).judge.quads, JudgedQuads::Labeled);
}

TEST(Plan, TheDualFollowsThePairing) {
  const Target target = wrap_target(test::unit_cube_surface());
  MeshOptions wishes;
  wishes.complete.pairing = Pairing::Sheets;
  EXPECT_EQ(plan(wishes, target).dual.mode, DualMode::Sheets);
  for (Pairing pairing : {Pairing::Blocks, Pairing::Octree}) {
    wishes.complete.pairing = pairing;
    EXPECT_EQ(plan(wishes, target).dual.mode, DualMode::Blocks);
  }
}

TEST(Plan, LevelsAreEvenedOutForTheOwnSizingOnly) {
  const Target target = wrap_target(test::unit_cube_surface());
  MeshOptions wishes;
  EXPECT_GT(plan(wishes, target).even.transition_cost, 0);
  wishes.sizing.sizing = Sizing::Thickness;
  EXPECT_EQ(plan(wishes, target).even.transition_cost, 0);
}

TEST(Plan, TheBackgroundStaysAsGiven) {
  MeshOptions wishes;
  EXPECT_EQ(plan_target(wishes).placement, Placement::Faces);
  wishes.fit.carve.side = Side::Both;
  EXPECT_EQ(plan_target(wishes).placement, Placement::AsGiven);
}

TEST(Plan, DefectiveSurfacesGetAShareOfTheBudget) {
  MeshOptions wishes;
  const Budgets sound = plan(wishes, wrap_target(test::unit_cube_surface())).budgets;
  const Budgets open = plan(wishes, wrap_target(open_cube())).budgets;
  EXPECT_EQ(sound.rounds, wishes.max_loop_hexes);
  EXPECT_EQ(open.rounds, wishes.max_loop_hexes / 4);
  EXPECT_TRUE(open.is_shortened);  // which the sentence says
  EXPECT_NE(say_exceeded(Budget::Rounds, 1e6, open).find("a quarter"), std::string::npos);
  EXPECT_EQ(say_exceeded(Budget::Rounds, 1e6, sound).find("a quarter"), std::string::npos);
  EXPECT_EQ(open.background, wishes.max_hexes);
  EXPECT_EQ(sound.growth, std::numeric_limits<double>::infinity());
  EXPECT_LT(open.growth, 3);
}

TEST(Plan, GuardsFollowALargeBudgetOfHexes) {
  MeshOptions wishes;
  wishes.most_hexes = 10'000'000;
  const StagePlan large = plan(wishes, wrap_target(test::unit_cube_surface()));
  EXPECT_GE(large.budgets.background, wishes.most_hexes);
  EXPECT_GE(large.budgets.rounds, wishes.most_hexes);
  EXPECT_GE(large.sizing.max_cells, wishes.most_hexes);
  EXPECT_GE(large.even.max_cells, wishes.most_hexes);
  wishes.most_hexes = std::numeric_limits<std::size_t>::max();
  const StagePlan largest = plan(wishes, wrap_target(test::unit_cube_surface()));
  EXPECT_GE(largest.budgets.background, large.budgets.background);
  EXPECT_GE(largest.budgets.rounds, large.budgets.rounds);
  wishes.most_hexes = 1000;
  const StagePlan small = plan(wishes, wrap_target(test::unit_cube_surface()));
  EXPECT_EQ(small.budgets.background, wishes.max_hexes);
  EXPECT_EQ(small.even.max_cells, wishes.even.max_cells);
}

TEST(Budgets, SayWhichHowMuchAndWhatToDo) {
  const Budgets budgets{.background = 1000, .rounds = 5000, .growth = 2.5};
  EXPECT_EQ(say_exceeded(Budget::Background, 1234, budgets),
            "the background mesh would have 1234 cells, more than the budget of 1000; raise "
            "--max-hexes or the tolerance");
  EXPECT_NE(say_exceeded(Budget::Rounds, 6000, budgets)
                .find("6000 hexes, more than the budget of "
                      "5000"),
            std::string::npos);
  const std::string growth = say_exceeded(Budget::Growth, 3.25, budgets);
  EXPECT_NE(growth.find("3.25 times the cells"), std::string::npos) << growth;
  EXPECT_NE(growth.find("repair the surface"), std::string::npos) << growth;
}

// The stages called one after the other see what mesh_surface sees.
TEST(Plan, StagesByHandGiveTheSameGrid) {
  TriMesh surface = test::unit_sphere_surface(3);
  for (Vec3& p : surface.positions) p = p * 37.0 + Vec3{100, 200, 300};
  MeshOptions wishes;
  wishes.target.placement = Placement::AsGiven;
  wishes.max_rounds = 0;
  wishes.sizing.max_level = 4;
  const SizingResult sizing = size_surface(surface, wishes, {});
  const MeshResult whole = mesh_surface(surface, wishes, {});
  EXPECT_EQ(sizing.grid.cells, whole.sizing.grid.cells);
  EXPECT_EQ(sizing.grid.frame, whole.sizing.grid.frame);
}

}  // namespace
}  // namespace hexwright
