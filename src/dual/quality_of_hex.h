// Scaled Jacobian of the hexes, in bulk.
#pragma once

#include "hexwright/mesh/hex_mesh.h"

namespace hexwright::dual {

struct MeshQuality {
  double min = 1, avg = 0;
  std::size_t num_inverted = 0;  ///< hexes with a corner whose Jacobian is not positive
};

MeshQuality measure_quality(const HexMesh& mesh);

}  // namespace hexwright::dual
