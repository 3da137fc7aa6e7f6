// Solves a small grid's whole hierarchy through the installed integer-program component.
#include <cstdio>

#include "hexwright/grid/ilp.h"

int main() {
  using namespace hexwright;
  Grid grid = make_root_grid({{0, 0, 0}, 1.0});
  grid = split_cells(grid, {1});
  grid = split_cells(grid, {1, 0, 0, 0, 0, 0, 0, 0});
  const IlpResult best = complete_by_ilp(grid, {Balance::Weak, IlpScope::Hierarchy, 30}, {});
  std::printf("%s: %zu cells\n", ilp_solver_name().c_str(), best.num_cells);
  return best.is_optimal && best.num_cells >= grid.num_cells() ? 0 : 1;
}
