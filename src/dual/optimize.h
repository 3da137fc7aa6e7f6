// Moves vertices until no hex is inverted and bad corners are few; boundary vertices slide in the
// domain's faces.
#pragma once

#include "hexwright/base/context.h"

#include "dual/complex/positions.h"

namespace hexwright::dual {

/// Untangles the mesh, then raises its least scaled Jacobians. Only vertices near bad hexes move.
/// Deterministic for any number of threads. Returns how many boundary vertices had to leave the
/// domain's boundary because nothing else untangled the mesh (0 on boxes).
/// `vert_to_hex`: of the mesh.
std::size_t optimize_positions(HexMesh& mesh, VertToHex vert_to_hex, const FixedAxes& fixed_axes,
                               const Context& context);

}  // namespace hexwright::dual
