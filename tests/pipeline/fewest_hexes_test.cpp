// The promise of the pipeline: sheets never cost more hexes than blocks.
#include "hexwright/pipeline/fewest_hexes.h"

#include <gtest/gtest.h>

#include "hexwright/dual/dual_mesh.h"
#include "hexwright/io/grid_io.h"

#include "dual/random_grids.h"
#include "helpers.h"

namespace hexwright::test {
namespace {

const CompleteOptions kSheets{Balance::Auto, Pairing::Sheets};
const CompleteOptions kBlocks{Balance::Auto, Pairing::Blocks};

std::size_t count_by_blocks(const Grid& input) {
  return count_dual_hexes(complete(input, kBlocks, {}).grid, DualMode::Blocks, {});
}

TEST(FewestHexes, SheetsNeverNeedMoreHexesThanBlocks) {
  int num_by_blocks = 0;
  for (unsigned seed = 0; seed < 250; ++seed) {
    const Grid input = random_unbalanced_tree(seed, random_box(seed)).grid();
    const Grid grid = complete_with_fewest_hexes(input, kSheets, {}).grid;
    const std::size_t count = count_dual_hexes(grid, DualMode::Sheets, {});
    EXPECT_LE(count, count_by_blocks(input)) << seed;
    const Grid by_sheets = complete(input, kSheets, {}).grid;
    EXPECT_LE(count, count_dual_hexes(by_sheets, DualMode::Sheets, {})) << seed;
    num_by_blocks += grid.num_cells() != by_sheets.num_cells();
  }
  EXPECT_GT(num_by_blocks, 0) << "the grids do not put the fallback to the test";
}

TEST(FewestHexes, OtherPairingsAreLeftAlone) {
  const Grid input = random_unbalanced_tree(2, random_box(2)).grid();
  for (const Pairing pairing : {Pairing::None, Pairing::Blocks, Pairing::Octree}) {
    const CompleteOptions options{Balance::Auto, pairing};
    EXPECT_EQ(complete_with_fewest_hexes(input, options, {}).grid.cells,
              complete(input, options, {}).grid.cells);
  }
}

TEST(FewestHexes, HoldsOnTheBaselineGrids) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  for (const char* name : {"3holes", "cube", "cow", "soccerball", "thintorus", "torus", "tripod"}) {
    const Grid input = read_grid(shared_dir() / "baseline/grids" / (std::string(name) + ".cells"));
    const Grid grid = complete_with_fewest_hexes(input, kSheets, {}).grid;
    EXPECT_LE(count_dual_hexes(grid, DualMode::Sheets, {}), count_by_blocks(input)) << name;
  }
}

TEST(FewestHexes, CountIsThatOfTheMesh) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Grid grid = random_balanced_tree(seed, random_box(seed)).grid();
    const auto mesh = build_dual(grid, {DualMode::Sheets, false, false}, {}).mesh;
    EXPECT_EQ(count_dual_hexes(grid, DualMode::Sheets, {}), mesh.num_hexes()) << seed;
  }
}

}  // namespace
}  // namespace hexwright::test
