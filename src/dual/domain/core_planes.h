// Chooses, per depth, cluster and axis, which lattice planes carry the pillows.
//
// Each split node has one core face per axis: the pillow of that axis runs on both sides of it,
// half a node away. All nodes around a vertex must agree on their core planes, so the choice is one
// parity per axis for each 26-connected cluster of nodes (docs/algorithms/dual.md, "Core planes").
#pragma once

#include <span>

#include "dual/domain/domain.h"

namespace hexwright::dual {

struct CorePlaneReport {
  std::size_t num_partners = 0;  ///< cells of the domain cut by a pillow without being split
};

/// Sets the parity of every group at depth `depth` so that the fewest partners are cut; among
/// equals so that the pillows have the fewest squares. No core plane is led through a vertex of
/// `avoid` (on the lattice of the roots) unless other such vertices of its cluster leave no choice.
CorePlaneReport choose_core_planes(SplitNodes& nodes, int depth, const Domain& domain,
                                   std::span<const LatticeCoord> avoid);

}  // namespace hexwright::dual
