// Unsplit cells that the pillows of two or more axes run through: splitting them instead gives
// better elements for about one percent more of them.
#pragma once

#include "dual/domain/domain.h"

namespace hexwright::dual {

/// Adds to `nodes` (of depth `depth`, core planes chosen) the cells crossed by pillows of at least
/// two axes, where such a cell is a leaf of this depth: its parent is in `above`, which is null at
/// depth 0. Returns how many; the core planes must then be chosen anew.
std::size_t split_crossed_cells(SplitNodes& nodes, const SplitNodes* above, int depth,
                                const Domain& domain);

}  // namespace hexwright::dual
