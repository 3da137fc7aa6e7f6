// Removes transitions between levels that cost more than they save.
//
// A coarse cell inside the object saves hexes, but the transitions around it cost hexes and
// quality: an object a few cells thick is better meshed with cells of one size.
#pragma once

#include "hexwright/base/context.h"
#include "hexwright/grid/complete.h"
#include "hexwright/grid/grid.h"
#include "hexwright/grid/occupancy.h"

namespace hexwright {

struct EvenOptions {
  /// What a leaf with a face neighbour of another level counts more than one without, for the
  /// quality lost there; 0 = the grid is only completed.
  double transition_cost = 5;
  std::size_t max_cells = 2'000'000;  ///< evened grids that are larger once completed are out
  /// Evened grids with more cells in the object are out: a large mesh is not doubled for its
  /// shapes.
  std::size_t max_object_cells = 75'000;
};

struct EvenedGrid {
  CompleteResult completed;  ///< the evened grid, balanced and paired
  int base_level = 0;        ///< the object's cells are at least this deep; 0 = nothing was split
  double cost = 0;           ///< leaves in the object, those at transitions weighted
};

/// Completes the grid as it is, and with all cells that meet the surface or lie inside it split to
/// at least level 1, 2, ..., and returns the cheapest: the sum over the leaves in the object of 1,
/// or 1 + transition_cost where levels meet. Cells outside, which the carve removes, count nothing.
///
/// Errors: those of complete(). Same result for any thread count.
EvenedGrid even_levels(const Grid& grid, const Occupancy& object, const CompleteOptions& complete,
                       const EvenOptions& options, const Context& context);

}  // namespace hexwright
