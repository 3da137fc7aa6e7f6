// What is still poor after the lift lies in few places, where the lattice met the surface badly by
// chance: finer cells meet it there in another way.
#pragma once

#include "pipeline/loop/loop.h"

namespace hexwright {

/// Middles of the hexes whose least scaled Jacobian is below `goal`, without those that hold a
/// wedge of the boundary sharper than that: finer cells hold the same wedge.
std::vector<Vec3> find_poor_places(const HexMesh& mesh, double goal);

/// Splits the leaves that hold poor hexes of a lifted round, and those that are not proven positive
/// inside, fits and lifts again, a few times, and returns the round with the fewest unproven hexes,
/// and of these with the largest least scaled Jacobian, among those that meet what the lifted one
/// meets at little more hexes. Fills the result's rounds.
Round refine_where_poor(const RoundInput& input, Round lifted, MeshResult& result);

}  // namespace hexwright
