// An adaptive grid: an octree over any union of unit root cubes, as its leaves in Morton order.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "hexwright/base/ids.h"
#include "hexwright/base/issue.h"
#include "hexwright/base/vec3.h"
#include "hexwright/geometry/similarity.h"

namespace hexwright {

using CellId = Id<struct CellTag>;  ///< leaf of an adaptive grid

/// Integer position on some lattice of a grid.
using LatticeCoord = std::array<std::int32_t, 3>;

/// Deepest level a grid may have; root coordinates must stay within +-2^10 at this depth.
inline constexpr int kMaxGridLevel = 20;

/// A leaf. `corner` is its low corner on the finest lattice of the grid, where a root cube has edge
/// 2^finest_level.
struct GridCell {
  LatticeCoord corner = {0, 0, 0};
  std::int8_t level = 0;  ///< 0 = root cube
  std::uint8_t flags = 0;
  std::uint16_t reserved = 0;
  friend bool operator==(const GridCell&, const GridCell&) = default;
};
static_assert(sizeof(GridCell) == 16);

/// Where the lattice lies in the world: root cube (i,j,k) covers origin + root_size * stretch *
/// [i,i+1]x[j,j+1]x[k,k+1], axis by axis.
struct GridFrame {
  Vec3 origin;
  double root_size = 1;
  /// At most 1: cells are bricks where lengths along an axis are to be met that hold no whole
  /// number of cubes. Sizes are compared by a cell's longest edge.
  Vec3 stretch = {1, 1, 1};
  /// Edge of a root along an axis.
  double root_edge(int axis) const { return root_size * stretch[axis]; }
  /// From unit coordinates; along the axes of the frame's pose.
  void to_world(const Similarity& frame) {
    origin = frame.to_world(origin);
    root_size = frame.length_to_world(root_size);
  }
  friend bool operator==(const GridFrame&, const GridFrame&) = default;
};

/// A lattice and which of its roots there are, sorted (z, y, x).
struct GridDomain {
  GridFrame frame;
  std::vector<LatticeCoord> roots;
};

struct Grid {
  GridFrame frame;
  int finest_level = 0;              ///< deepest level of any cell
  std::vector<LatticeCoord> roots;   ///< root cubes, sorted (z, y, x); {0,0,0} alone for a surface
  IdVector<CellId, GridCell> cells;  ///< leaves, in order of (root, Morton)

  std::size_t num_cells() const { return cells.size(); }
  /// Edge of a cell on the finest lattice.
  std::int32_t cell_size(CellId c) const { return 1 << (finest_level - cells[c].level); }

  /// First violation: cells must tile the roots exactly, in order.
  std::optional<Issue> find_problem() const;
};

/// World position of a point of the finest lattice: the only place where lattice becomes world.
inline Vec3 lattice_to_world(const Grid& grid, const LatticeCoord& p) {
  const double h = grid.frame.root_size / static_cast<double>(1 << grid.finest_level);
  const Vec3& s = grid.frame.stretch;
  return grid.frame.origin + Vec3{p[0] * h * s.x, p[1] * h * s.y, p[2] * h * s.z};
}

/// World box of a leaf.
inline Box3 cell_box(const Grid& grid, CellId c) {
  const auto& corner = grid.cells[c].corner;
  const std::int32_t s = grid.cell_size(c);
  return {lattice_to_world(grid, corner),
          lattice_to_world(grid, {corner[0] + s, corner[1] + s, corner[2] + s})};
}

/// The single root cube (0,0,0) unsplit.
Grid make_root_grid(const GridFrame& frame);

/// A grid from cells given as {level, i, j, k} on their own level's lattice (the `.cells`
/// convention). Throws Error{BadFile} naming the first cell that overlaps another, lies outside the
/// roots or leaves a gap.
struct CellSpec {
  int level = 0;
  LatticeCoord index = {0, 0, 0};
};
Grid make_grid(const GridFrame& frame, std::vector<LatticeCoord> roots,
               const std::vector<CellSpec>& cells);

/// The grid with the marked leaves split once more into eight. One flag per cell.
Grid split_cells(const Grid& grid, const std::vector<char>& is_marked);

/// Number of leaves per level, 0 .. finest_level.
std::vector<std::size_t> count_cells_per_level(const Grid& grid);

}  // namespace hexwright
