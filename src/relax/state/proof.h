// Positivity inside hexes, as the passes that must not lose it see it.
#pragma once

#include <vector>

#include "relax/kernel/body.h"

namespace hexwright::relax {

/// Hexes whose Jacobian is not proven positive everywhere inside, in order.
std::vector<HexId> find_unproven(const HexMesh& mesh);

/// Hexes whose corners are better are nearly always positive inside: passes that check after every
/// move leave those to the last pass.
constexpr double kProvenQuality = 0.5;

/// How many of them are at the vertex.
int count_unproven_around(const Body& body, VertId v);

}  // namespace hexwright::relax
