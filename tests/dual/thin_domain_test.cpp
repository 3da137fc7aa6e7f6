// Domains that are one root cube thick: refinement must not depend on how the roots are counted.
#include "hexwright/dual/dual_mesh.h"

#include "helpers.h"

namespace hexwright {
namespace {

// Five cubes along a path that turns twice out of plane; it has corners without a hex of their own.
const std::vector<LatticeCoord> kCrookedPath = {
    {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 1, 1}};

Grid uniform_grid(const std::vector<LatticeCoord>& cubes, int cubes_per_edge, int level) {
  std::vector<LatticeCoord> roots;
  const int n = cubes_per_edge;
  for (const auto& c : cubes)
    for (int k = 0; k < n * n * n; ++k)
      roots.push_back({c[0] * n + k % n, c[1] * n + k / n % n, c[2] * n + k / n / n});
  std::vector<CellSpec> cells;
  for (const auto& root : roots) cells.push_back({0, root});
  Grid grid = make_grid({{0, 0, 0}, 1.0 / n}, roots, cells);
  for (int l = 0; l < level; ++l) grid = split_cells(grid, std::vector<char>(grid.num_cells(), 1));
  return grid;
}

TEST(ThinDomain, SplittingCellsEqualsSplittingRoots) {
  for (int level : {1, 2, 3}) {
    const auto split = build_dual(uniform_grid(kCrookedPath, 1, level), {}, {});
    const auto fine = build_dual(uniform_grid(kCrookedPath, 1 << level, 0), {}, {});
    EXPECT_EQ(split.mesh.num_hexes(), fine.mesh.num_hexes()) << "level " << level;
    EXPECT_EQ(split.report.num_cap_hexes, 0u);
  }
}

}  // namespace
}  // namespace hexwright
