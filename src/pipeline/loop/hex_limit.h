// The number of hexes that the result may have (MeshOptions::most_hexes).
#pragma once

#include <string>

#include "pipeline/loop/round.h"

namespace hexwright {

/// Whether the round's mesh keeps to it.
bool is_within_limit(const RoundInput& input, const Round& round);

/// Whether a mesh of this grid may, by the leaves with their centres in what is meshed: said before
/// the mesh is made, with room for those that are carved away at the boundary.
bool may_be_within_limit(const RoundInput& input, const Grid& grid);

/// What to say of a mesh that does not: the budget, and what to do by the wishes that size cells.
std::string say_beyond_limit(const MeshOptions& options);

}  // namespace hexwright
