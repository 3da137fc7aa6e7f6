// Scaled Jacobian of the hexes, in bulk.
#pragma once

#include "hexwright/mesh/hex_mesh.h"

namespace hexwright::dual {

struct MeshQuality {
  double min = 1, avg = 0;
  std::size_t num_inverted = 0;  ///< hexes with a corner whose Jacobian is not positive
};

/// Smooth stand-in for the scaled Jacobian of a hex: the mean over the corners to the power -8,
/// raised to -1/8; at least the scaled Jacobian and at most 1.3 times it. 0 when a corner is
/// inverted.
double soft_scaled_jacobian(const HexMesh& mesh, HexId h);

MeshQuality measure_quality(const HexMesh& mesh);

}  // namespace hexwright::dual
