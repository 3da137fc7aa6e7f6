// Finds the one defect that pillows can leave on grids that are not paired: two quads that share
// two of their edges.
#pragma once

#include "dual/complex/hex_complex.h"

namespace hexwright::dual {

/// The vertices between two such edges, in order. Around them elements cannot be made convex. A
/// pillow's cap may run into another pillow this way inside a cell that neither of them cuts.
std::vector<VertId> find_double_links(const HexComplex& complex);

/// Mean place of the hexes around each of these vertices, on the finest lattice.
std::vector<Vec3> mean_places(const HexComplex& complex, const std::vector<VertId>& verts);

}  // namespace hexwright::dual
