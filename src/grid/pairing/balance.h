// What a depth requires of the depth above it, by balance.
#pragma once

#include "hexwright/grid/complete.h"

#include "grid/sets/brick_set.h"
#include "grid/sets/lattice_domain.h"

namespace hexwright::grids {

/// The nodes of depth - 1 that must be split so that every node of `split` (of this depth, >= 1)
/// and all its neighbours in the domain exist: parents(split + N(split)), united with `input`.
BrickSet required_above(const BrickSet& split, int depth, Balance balance,
                        const LatticeDomain& domain, const BrickSet& input);

/// The same two depths above, for the relaxed rule: every node of `split` (of this depth, >= 2) and
/// all its neighbours in the domain lie in nodes of depth - 1.
BrickSet required_two_above(const BrickSet& split, int depth, const LatticeDomain& domain,
                            const BrickSet& input);

/// Grows one brick's nodes by their neighbours; entry n is what lands in neighbour n.
std::array<BrickBits, 27> grow_by_neighbours(BrickBits w, Balance balance);

}  // namespace hexwright::grids
