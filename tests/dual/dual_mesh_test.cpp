#include "hexwright/dual/dual_mesh.h"

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"

#include "dual/dual_helpers.h"

namespace hexwright::test {
namespace {

const DualOptions kRaw{DualMode::Blocks, false, false};

// Hex counts of one 2x2x2 block in a 4x4x4 grid, by the block's centre.
TEST(DualMesh, CountsOfOneBlockByPlace) {
  const std::vector<std::pair<LatticeCoord, std::size_t>> expected = {
      {{0, 0, 0}, 159}, {{0, 0, 1}, 175}, {{0, 0, 2}, 180}, {{0, 1, 1}, 202}, {{0, 1, 2}, 208},
      {{0, 2, 2}, 214}, {{1, 1, 1}, 247}, {{1, 1, 2}, 255}, {{1, 2, 2}, 263}, {{2, 2, 2}, 271}};
  for (const auto& [center, count] : expected) {
    const Grid grid = grid_of_blocks(4, {{0, center}});
    const auto result = build_dual(grid, kRaw, {});
    EXPECT_EQ(result.mesh.num_hexes(), count) << center[0] << center[1] << center[2];
    EXPECT_EQ(find_mesh_problem(result.mesh, grid), "");
    EXPECT_GT(result.report.min_scaled_jacobian_raw, 0.18);
  }
}

TEST(DualMesh, IsolatedBlockHas48Caps) {
  const auto result = build_dual(grid_of_blocks(4, {{0, {2, 2, 2}}}), kRaw, {});
  EXPECT_EQ(result.report.num_cap_hexes, 48u);
  EXPECT_NEAR(result.report.min_scaled_jacobian_raw, 0.249, 0.001);
}

TEST(DualMesh, CountsOfNestedBlocks) {
  const std::vector<BlockSpec> blocks = {{0, {2, 2, 2}}, {1, {4, 4, 4}}, {2, {8, 8, 8}}};
  const std::size_t expected[] = {271, 417, 563};
  for (std::size_t n = 1; n <= 3; ++n) {
    const Grid grid = grid_of_blocks(4, {blocks.begin(), blocks.begin() + static_cast<long>(n)});
    const auto result = build_dual(grid, kRaw, {});
    EXPECT_EQ(result.mesh.num_hexes(), expected[n - 1]);
    EXPECT_EQ(find_mesh_problem(result.mesh, grid), "");
  }
}

// 2x2x2 roots with some left out.
TEST(DualMesh, CountsOfCubesWithoutCorners) {
  const auto count = [](std::set<LatticeCoord> missing) {
    std::vector<LatticeCoord> roots;
    for (const LatticeCoord& r : box_roots(2, 2, 2))
      if (!missing.count(r)) roots.push_back(r);
    const Grid grid = grid_of_splits(roots, {});
    const auto result = build_dual(grid, kRaw, {});
    EXPECT_EQ(find_mesh_problem(result.mesh, grid), "");
    return result.mesh.num_hexes();
  };
  EXPECT_EQ(count({}), 27u);
  EXPECT_EQ(count({{1, 1, 1}}), 31u);
  EXPECT_EQ(count({{1, 1, 1}, {1, 1, 0}}), 27u);
  EXPECT_EQ(count({{1, 1, 1}, {1, 0, 1}, {0, 1, 1}}), 23u);
}

// The inset mesh is what lies between the centres of the outermost cells.
TEST(DualMesh, InsetDropsTheHalfCells) {
  const Grid grid = grid_of_blocks(5, {{0, {2, 2, 2}}});
  const auto result = build_dual(grid, {DualMode::Blocks, true, true}, {});
  EXPECT_EQ(find_mesh_problem(result.mesh, grid, false), "");
  const Box3 box = bounding_box(result.mesh);
  EXPECT_EQ(box.lo, (Vec3{0.5, 0.5, 0.5}));
  EXPECT_EQ(box.hi, (Vec3{4.5, 4.5, 4.5}));
  EXPECT_GT(result.report.min_scaled_jacobian, 0.2);
}

TEST(DualMesh, DoesNotDependOnTheNumberOfThreads) {
  SplitTree tree(box_roots(6, 6, 6));
  for (int k = 0; k < 4; ++k) tree.split(2, {4 + 4 * k, 6 + 3 * k, 9 + k});
  tree.balance(false);
  const Grid grid = tree.grid();
  const auto build = [&](int threads) {
    const ThreadLimit limit(threads);
    return build_dual(grid, {DualMode::Sheets, false, true}, {}).mesh;
  };
  const HexMesh one = build(1), three = build(3);
  EXPECT_EQ(one.positions, three.positions);
  EXPECT_EQ(one.hexes, three.hexes);
}

// A refined corner costs sheets mode less than completing the blocks costs blocks mode.
TEST(DualMesh, SheetsNeverNeedMoreHexesThanBlocks) {
  SplitTree sheets(box_roots(4, 4, 4));
  sheets.split(0, {1, 1, 1});
  SplitTree blocks = sheets;
  blocks.split_block({0, {2, 2, 2}});
  const auto by_sheets = build_dual(sheets.grid(), {DualMode::Sheets, false, false}, {});
  const auto by_blocks = build_dual(blocks.grid(), kRaw, {});
  EXPECT_LE(by_sheets.report.num_hexes, by_blocks.report.num_hexes);
}

TEST(DualMesh, BlocksModeRejectsUnpairedGrids) {
  const Grid grid = grid_of_splits(box_roots(3, 3, 3), {{0, {1, 1, 1}}});
  try {
    build_dual(grid, kRaw, {});
    FAIL() << "accepted";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::BadArgument);
  }
}

}  // namespace
}  // namespace hexwright::test
