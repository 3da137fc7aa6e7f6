// Weights of hexes with which a weighted energy raises the mean scaled Jacobian.
#pragma once

#include "hexwright/mesh/hex_mesh.h"

namespace hexwright::relax {

/// Smooth stand-in for the scaled Jacobian of a hex: the mean over the corners to the power -2p,
/// raised to -1/2p; at least the scaled Jacobian and at most 8^(1/2p) times it. 0 when a corner is
/// inverted. `power`: p, a power of 2.
double soft_scaled_jacobian(const std::array<Vec3, 8>& corners, int power);

/// Per hex: lowering the energy of that power with these weights raises the mean of the stand-ins.
/// Hexes whose stand-in is below `knee` weigh as those at it: from there down the plain energy is
/// what falls, which holds up the least.
IdVector<HexId, double> mean_weights(const HexMesh& mesh, int power, double knee = 0);

}  // namespace hexwright::relax
