// Random grids: every one must give a valid mesh of its domain.
#include <random>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/dual/dual_mesh.h"

#include "dual/dual_helpers.h"
#include "dual/random_grids.h"

namespace hexwright::test {
namespace {

void expect_valid(const SplitTree& tree, DualMode mode, const std::string& label) {
  const Grid grid = tree.grid();
  DualResult result;
  try {
    result = build_dual(grid, {mode, false, false}, {});
  } catch (const Error& e) {  // domains pinched along an edge
    EXPECT_EQ(e.code(), ErrorCode::BadGeometry) << label << ": " << e.what();
    EXPECT_FALSE(tree.is_box()) << label;
    return;
  }
  EXPECT_EQ(find_mesh_problem(result.mesh, grid, tree.is_box()), "") << label;
  const bool is_paired_box = mode == DualMode::Blocks && tree.is_box();
  if (is_paired_box) {
    EXPECT_EQ(result.report.num_inverted_raw, 0u) << label;
  }
}

using TreeMaker = SplitTree (*)(unsigned seed, const std::vector<LatticeCoord>& roots);
using DomainMaker = std::vector<LatticeCoord> (*)(unsigned seed);

void expect_all_valid(unsigned num_seeds, TreeMaker make_tree, DomainMaker make_domain,
                      DualMode mode) {
  for (unsigned seed = 0; seed < num_seeds; ++seed)
    expect_valid(make_tree(seed, make_domain(seed)), mode, "seed " + std::to_string(seed));
}

TEST(RandomGrid, PairedBoxes) {
  expect_all_valid(100, random_paired_tree, random_box, DualMode::Blocks);
}
TEST(RandomGrid, BalancedBoxesBySheets) {
  expect_all_valid(100, random_balanced_tree, random_box, DualMode::Sheets);
}
TEST(RandomGrid, UnbalancedBoxesBySheets) {
  expect_all_valid(100, random_unbalanced_tree, random_box, DualMode::Sheets);
}
TEST(RandomGrid, PairedDomains) {
  expect_all_valid(100, random_paired_tree, random_domain, DualMode::Blocks);
}
TEST(RandomGrid, BalancedDomainsBySheets) {
  expect_all_valid(100, random_balanced_tree, random_domain, DualMode::Sheets);
}

}  // namespace
}  // namespace hexwright::test
