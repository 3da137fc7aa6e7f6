// How large the cells of a grid may be, place by place, and grids that keep to it.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "hexwright/base/function_ref.h"
#include "hexwright/grid/grid.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

/// Bounds of cells' edges, in the coordinates of the grid. An octree has only the sizes of its
/// levels: cells are the largest ones within the bound.
struct SizeField {
  /// The largest edge of a cell with this box, infinity where nothing is asked for. Called from
  /// several threads at once.
  using Limit = std::function<double(const Box3& cell)>;
  std::vector<Limit> limits;    ///< the least counts
  double least_edge = 0;        ///< no cell is split below this
  int deepest = kMaxGridLevel;  ///< nor is any below this level
  bool is_exact = false;        ///< nor is any more than one level finer than its bound
  /// The largest growth of edges over distance: cells of edge e lie at least (e - h) / (growth - 1)
  /// from those of edge h that were there before. 0 = what balance leaves.
  double growth = 0;

  bool empty() const { return limits.empty() && least_edge <= 0 && growth <= 0; }
  double limit(const Box3& cell) const;
  /// Cells here must not have smaller edges; 0 = any.
  double least(const Box3& cell) const;
};

/// Whether the field allows the leaf to be split.
bool may_split(const Grid& grid, CellId leaf, const SizeField& field);

/// Whether a leaf with this box is part of what is meshed, or beside it; others may be coarser.
using IsNeeded = FunctionRef<bool(const Box3& cell)>;

/// Splits needed leaves until each keeps to the field's limits and then to its growth. Sizes are
/// compared by the frame's `root_size`. Same result for any thread count.
/// Errors: OutOfResources, with the count, as soon as the grid would have more than `max_cells`
/// leaves, or one of them would have to be smaller than those of the deepest level there is.
Grid refine_to_sizes(Grid grid, const SizeField& field, IsNeeded is_needed, std::size_t max_cells);

/// A domain of one root around the box, enlarged on each side by the margin (share of its longest
/// extent), whose cells at some level have the longest edge `edge` exactly. Along each axis the
/// lattice is moved, and cells shortened by at most a quarter, so that as much as possible of the
/// surface's area that lies across the axis falls onto planes between hexes, which are the
/// mid-planes of cells. `level` of the result: that of the edge.
struct SizedDomain {
  GridDomain domain;
  int level = 0;
};
SizedDomain fit_lattice(const TriMesh& surface, double edge, double margin);

/// A domain that fills a box exactly by whole roots, `edge` over a power of two being the longest
/// edge of the cells of a level: bricks where the box's lengths are no multiples of a root. Roots
/// are at most as long as the shortest side over `least_roots`.
SizedDomain fill_box(const Box3& box, double edge, int least_roots);

}  // namespace hexwright
