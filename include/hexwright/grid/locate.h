// Which leaf holds a point.
#pragma once

#include "hexwright/grid/grid.h"

namespace hexwright {

/// The leaf whose half-open box holds a world position, by binary search; invalid outside the
/// roots.
CellId find_leaf_at(const Grid& grid, const Vec3& p);

}  // namespace hexwright
