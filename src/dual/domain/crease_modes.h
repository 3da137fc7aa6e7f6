// How the base mesh treats each convex crease of the domain: with hexes of its own, or without.
#pragma once

#include <vector>

#include "dual/domain/octant_star.h"

namespace hexwright::dual {

/// Per star, bit (2 * axis + side) of each convex half-edge at its vertex whose crease is wrapped:
/// the two boundary faces beside it become one. All other creases are clipped: a row of quarter
/// hexes runs along them. Wrapping is forced, and spreads along creases, where no arrangement of
/// clipped creases exists (docs/algorithms/dual.md, "The base mesh").
std::vector<int> find_wrapped_creases(const std::vector<OctantStar>& stars);

}  // namespace hexwright::dual
