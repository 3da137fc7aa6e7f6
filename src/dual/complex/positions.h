// First positions of the vertices, from the places of the hexes around them.
#pragma once

#include "hexwright/mesh/hex_adjacency.h"

#include "dual/complex/hex_complex.h"
#include "dual/domain/domain.h"

namespace hexwright::dual {

/// Bit a is set when a vertex may not move along axis a: it lies on a boundary plane across it.
using FixedAxes = IdVector<VertId, std::uint8_t>;

/// Place of every hex on the finest lattice.
IdVector<HexId, Vec3> compute_places(const HexComplex& complex);

/// Sets `mesh.positions` (one per vertex, in units of the finest lattice): the mean of the distinct
/// places of a vertex's hexes, moved into the planes of the domain's boundary that it lies on.
/// `mesh.hexes` holds the complex's hexes. Returns the axes that stay fixed.
FixedAxes place_verts(const Domain& domain, const HexComplex& complex, const VertToHex& vert_to_hex,
                      HexMesh& mesh);

}  // namespace hexwright::dual
