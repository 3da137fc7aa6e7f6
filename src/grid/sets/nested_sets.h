// A grid as nested sets: per depth, the lattice nodes that are split.
//
// number of leaves = number of roots + 7 * total number of split nodes.
#pragma once

#include <vector>

#include "grid/sets/brick_set.h"
#include "grid/sets/lattice_domain.h"

namespace hexwright::grids {

/// Entry d: split nodes of depth d, in the domain's shifted coordinates.
using NestedSets = std::vector<BrickSet>;

/// finest_level sets; none for an unsplit grid.
NestedSets split_sets_of(const Grid& grid, const LatticeDomain& domain);

/// The leaves of the sets, in the order of Grid::cells. Every split node's parent must be split.
Grid grid_of(const NestedSets& sets, const Grid& like, const LatticeDomain& domain);

}  // namespace hexwright::grids
