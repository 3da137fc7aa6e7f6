// Finds the leaves that hold given points.
#include "hexwright/grid/locate.h"
#include "hexwright/grid/sizing.h"

namespace hexwright {

std::vector<char> mark_cells_with_points(const Grid& grid, std::span<const Vec3> points,
                                         int max_level) {
  std::vector<char> marks(grid.num_cells(), 0);
  for (const Vec3& p : points) {
    const CellId c = find_leaf_at(grid, p);
    if (c.is_valid() && grid.cells[c].level < max_level) marks[c.index()] = 1;
  }
  return marks;
}

}  // namespace hexwright
