// Seeded random grids of small size.
#pragma once

#include "dual/dual_helpers.h"

namespace hexwright::test {

/// Roots of a box of 1 to 4 roots along each axis.
std::vector<LatticeCoord> random_box(unsigned seed);

/// Roots of a union of boxes, connected through faces, with every part at least two roots thick.
std::vector<LatticeCoord> random_domain(unsigned seed);

/// Random nodes split over up to four depths, then balanced: weakly for even seeds, strongly for
/// odd.
SplitTree random_balanced_tree(unsigned seed, const std::vector<LatticeCoord>& roots);

/// Random nodes split without any balance.
SplitTree random_unbalanced_tree(unsigned seed, const std::vector<LatticeCoord>& roots);

/// Blocks of one parity per depth; balanced and closed: a random paired grid.
SplitTree random_paired_tree(unsigned seed, const std::vector<LatticeCoord>& roots);

}  // namespace hexwright::test
