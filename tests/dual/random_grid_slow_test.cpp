// The nightly number of random grids, and every grid of the shared baseline.
#include <fstream>

#include <gtest/gtest.h>

#include "hexwright/grid/complete.h"
#include "hexwright/io/grid_io.h"

#include "dual/check_grid.h"
#include "helpers.h"

namespace hexwright::test {
namespace {

constexpr unsigned kFirst = 1000, kLast = 3000;

TEST(RandomGridSlow, PairedBoxes) {
  check_random_grids({random_paired_tree, random_box, DualMode::Blocks}, kFirst, kLast);
}
TEST(RandomGridSlow, BalancedBoxesBySheets) {
  check_random_grids({random_balanced_tree, random_box, DualMode::Sheets}, kFirst, kLast);
}
TEST(RandomGridSlow, UnbalancedBoxesBySheets) {
  check_random_grids({random_unbalanced_tree, random_box, DualMode::Sheets}, kFirst, kLast);
}
TEST(RandomGridSlow, PairedDomains) {
  check_random_grids({random_paired_tree, random_domain, DualMode::Blocks}, kFirst, kLast);
}
TEST(RandomGridSlow, BalancedDomainsBySheets) {
  check_random_grids({random_balanced_tree, random_domain, DualMode::Sheets}, kFirst, kLast);
}

struct BaselineGoal {
  CompleteOptions complete;
  DualMode mode;
  double min_sj, avg_sj;
};

TEST(BaselineGridsSlow, ReachTheirQualityInEveryMode) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  const BaselineGoal goals[] = {{{Balance::Weak, Pairing::Blocks}, DualMode::Blocks, 0.4, 0.78},
                                {{Balance::Strong, Pairing::Blocks}, DualMode::Blocks, 0.4, 0.78},
                                {{Balance::Weak, Pairing::Sheets}, DualMode::Sheets, 0.3, 0.7},
                                {{Balance::Relaxed, Pairing::Sheets}, DualMode::Sheets, 0.3, 0.7}};
  for (const auto& entry : std::filesystem::directory_iterator(shared_dir() / "baseline/grids")) {
    const Grid input = read_grid(entry.path());
    for (const BaselineGoal& goal : goals) {
      const Grid grid = complete(input, goal.complete, {}).grid;
      const auto result = build_dual(grid, {goal.mode, false, true}, {});
      EXPECT_EQ(find_mesh_problem(result.mesh, grid), "") << entry.path();
      EXPECT_GE(result.report.min_scaled_jacobian, goal.min_sj) << entry.path();
      EXPECT_GE(result.report.avg_scaled_jacobian, goal.avg_sj) << entry.path();
    }
  }
}

}  // namespace
}  // namespace hexwright::test
