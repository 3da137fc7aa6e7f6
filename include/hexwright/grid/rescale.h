// The same grid with all its cells a little smaller.
#pragma once

#include <span>

#include "hexwright/grid/grid.h"

namespace hexwright {

/// A grid around the same centre whose cells are `factor` times as large as those of `grid` at the
/// same place, or smaller (at the seams between levels maybe larger, within a quarter of a cell):
/// octrees halve cells, this scales them by any factor in between. The new root cube is
/// the smallest one whose cells have the wanted sizes and that has at least the edge
/// `least_root_size` (the old one's when 0); its cells are as coarse as they can be. `is_needed`,
/// one flag per leaf or empty: the other leaves' places may have larger cells.
///
/// Requires a single root and a factor in (0.5, 1]. Linear in leaves times levels.
/// Errors: BadArgument (the requirements), OutOfResources past kMaxGridLevel.
Grid rescale_grid(const Grid& grid, double factor, double least_root_size = 0,
                  std::span<const char> is_needed = {});

}  // namespace hexwright
