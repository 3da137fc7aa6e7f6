// Positions: what the stage's own optimisation promises.
#include "dual/optimize.h"

#include <random>

#include <gtest/gtest.h>

#include "hexwright/mesh/hex_shape.h"

#include "dual/check_grid.h"
#include "relax/passes/mean_weights.h"

namespace hexwright::test {
namespace {

// The unit cube with its corners moved by up to `amount`.
HexMesh bent_cube(unsigned seed, double amount) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(-amount, amount);
  HexMesh mesh;
  std::array<VertId, 8> hex;
  for (int bits = 0; bits < 8; ++bits) {
    const Vec3 corner(bits & 1, bits >> 1 & 1, bits >> 2);
    hex[kHexVertexOfBits[bits]] = VertId(mesh.num_verts());
    mesh.positions.push_back(corner + Vec3(offset(random), offset(random), offset(random)));
  }
  mesh.hexes.push_back(hex);
  return mesh;
}

TEST(SoftScaledJacobian, LiesBetweenTheLeastCornerAndItsMultiple) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const HexMesh mesh = bent_cube(seed, 0.3);
    const double least = scaled_jacobian(mesh.corners(HexId(0)));
    const double soft = relax::soft_scaled_jacobian(mesh.corners(HexId(0)), 4);
    if (least <= 0) {
      EXPECT_EQ(soft, 0) << seed;
      continue;
    }
    EXPECT_GE(soft, least * (1 - 1e-12)) << seed;
    EXPECT_LE(soft, least * 1.3) << seed;  // 8^(1/8) = 1.297
  }
  EXPECT_DOUBLE_EQ(relax::soft_scaled_jacobian(bent_cube(0, 0).corners(HexId(0)), 4), 1);
}

TEST(OptimizePositions, RaisesLeastAndMeanOnEveryRandomGrid) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Grid grid = random_balanced_tree(seed, random_box(seed)).grid();
    const auto raw = build_dual(grid, {DualMode::Sheets, false, false}, {}).report;
    const auto optimized = build_dual(grid, {DualMode::Sheets, false, true}, {}).report;
    EXPECT_EQ(raw.num_hexes, optimized.num_hexes);
    EXPECT_GE(optimized.min_scaled_jacobian, std::min(raw.min_scaled_jacobian, 0.4)) << seed;
    EXPECT_GE(optimized.avg_scaled_jacobian, raw.avg_scaled_jacobian - 1e-9) << seed;
  }
}

// A uniform grid is perfect from the start: not a vertex may move.
TEST(OptimizePositions, LeavesAUniformGridAlone) {
  const Grid grid = grid_of_splits(box_roots(3, 3, 3), {});
  const auto raw = build_dual(grid, {DualMode::Blocks, false, false}, {});
  const auto optimized = build_dual(grid, {DualMode::Blocks, false, true}, {});
  EXPECT_EQ(raw.mesh.positions, optimized.mesh.positions);
  EXPECT_EQ(optimized.report.avg_scaled_jacobian, 1);
}

TEST(OptimizePositions, KeepsBoundaryVerticesInTheirPlanes) {
  const Grid grid = grid_of_blocks(4, {{0, {1, 1, 2}}, {1, {2, 3, 4}}});
  const auto raw = build_dual(grid, {DualMode::Blocks, false, false}, {}).mesh;
  const auto optimized = build_dual(grid, {DualMode::Blocks, false, true}, {}).mesh;
  for (VertId v : raw.positions.ids())
    for (int a = 0; a < 3; ++a)
      for (const double plane : {0.0, 4.0})
        EXPECT_EQ(raw.positions[v][a] == plane, optimized.positions[v][a] == plane);
}

}  // namespace
}  // namespace hexwright::test
