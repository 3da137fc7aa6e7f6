// Completes a grid and turns it into hexes through the installed package.
#include <cstdio>

#include "hexwright/dual/dual_mesh.h"
#include "hexwright/grid/complete.h"

int main() {
  using namespace hexwright;
  Grid grid = make_root_grid({{0, 0, 0}, 1.0});
  grid = split_cells(grid, std::vector<char>(grid.num_cells(), 1));
  grid = split_cells(grid, {1, 0, 0, 0, 0, 0, 0, 0});
  const auto completed = complete(grid, {}, {});
  const auto dual = build_dual(completed.grid, {}, {});
  std::printf("%zu cells, %zu hexes\n", completed.grid.num_cells(), dual.mesh.num_hexes());
  return dual.mesh.num_hexes() > completed.grid.num_cells() ? 0 : 1;
}
