#include "hexwright/dual/dual_mesh.h"

#include <gtest/gtest.h>

#include "hexwright/base/error.h"

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
