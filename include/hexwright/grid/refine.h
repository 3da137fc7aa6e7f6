// Builds an adaptive grid from a size function, without any surface.
#pragma once

#include <vector>

#include "hexwright/base/function_ref.h"
#include "hexwright/grid/grid.h"

namespace hexwright {

/// Whether a cell with this world box, at this level, should be split. Called from several threads
/// at once, in any order, once per cell that comes into being.
using SplitTest = FunctionRef<bool(const Box3& box, int level)>;

/// The roots, split wherever `should_split` holds and no deeper than `max_level`. Not balanced or
/// paired: see complete(). Same result for any thread count. Time linear in the cells.
/// Errors: BadArgument when the roots are not sorted by (z, y, x), are repeated, or when
/// `max_level` lies outside 0 .. kMaxGridLevel.
Grid refine_where(const GridFrame& frame, std::vector<LatticeCoord> roots, int max_level,
                  SplitTest should_split);

}  // namespace hexwright
