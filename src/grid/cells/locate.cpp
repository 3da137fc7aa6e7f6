// Point location by binary search over the leaves' order of (root, Morton key).
#include "hexwright/grid/locate.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "grid/cells/morton.h"

namespace hexwright {

using namespace grids;

namespace {

/// The finest-lattice cell at a world position; absent outside the range of roots.
std::optional<LatticeCoord> lattice_cell_at(const Grid& grid, const Vec3& p) {
  const double h = grid.frame.root_size / static_cast<double>(1 << grid.finest_level);
  constexpr double kLimit = 1 << 30;
  LatticeCoord q;
  for (int axis = 0; axis < 3; ++axis) {
    const double x =
        std::floor((p[axis] - grid.frame.origin[axis]) / (h * grid.frame.stretch[axis]));
    if (!(std::abs(x) < kLimit)) return std::nullopt;
    q[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(x);
  }
  return q;
}

LatticeCoord root_of(const Grid& grid, const LatticeCoord& q) {
  return {q[0] >> grid.finest_level, q[1] >> grid.finest_level, q[2] >> grid.finest_level};
}

MortonKey key_of(const Grid& grid, const LatticeCoord& q) {
  const std::int32_t mask = (1 << grid.finest_level) - 1;
  return morton_encode(q[0] & mask, q[1] & mask, q[2] & mask);
}

/// The leaf that covers a cell of the finest lattice; invalid outside the roots.
CellId find_leaf(const Grid& grid, const LatticeCoord& q) {
  const LatticeCoord root = root_of(grid, q);
  if (!std::binary_search(grid.roots.begin(), grid.roots.end(), root, root_less)) return {};
  const auto& cells = grid.cells.raw();
  const auto after = std::upper_bound(cells.begin(), cells.end(), q,
                                      [&](const LatticeCoord& a, const GridCell& cell) {
                                        const LatticeCoord other = root_of(grid, cell.corner);
                                        if (root != other) return root_less(root, other);
                                        return key_of(grid, a) < key_of(grid, cell.corner);
                                      });
  return CellId(after - cells.begin() - 1);
}

}  // namespace

CellId find_leaf_at(const Grid& grid, const Vec3& p) {
  const auto q = lattice_cell_at(grid, p);
  return q ? find_leaf(grid, *q) : CellId();
}

}  // namespace hexwright
