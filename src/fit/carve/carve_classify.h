// How much of each hex of a background mesh the object fills.
#pragma once

#include "hexwright/geometry/surface_tree.h"
#include "hexwright/mesh/hex_adjacency.h"

namespace hexwright::fitting {

struct HexFilling {
  IdVector<HexId, float> fraction;  ///< filled share of the hex, about; in [0, 1]
  IdVector<HexId, char> is_near;    ///< 1: the surface runs within about half a hex of its centre
  IdVector<HexId, Vec3> nearest;    ///< the surface point nearest to the centre, of near hexes
  IdVector<HexId, double> edge;     ///< typical edge length of the hex
};

/// Filled fraction f = (cl(s_c) + mean over the 8 vertices cl(0.6 s_v)) / 2, where s is the signed
/// distance in units of the hex's edge (negative inside by winding number) and cl(s) = 1/2 - s
/// clamped to [0, 1]. Hexes far from the surface get 0 or 1.
HexFilling classify_hexes(const HexMesh& mesh, const VertToHex& vert_to_hex,
                          const HexNeighbors& neighbors, const SurfaceTree& surface);

}  // namespace hexwright::fitting
