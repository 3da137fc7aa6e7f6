// First positions of the vertices, from the places of the hexes around them.
#pragma once

#include "hexwright/mesh/hex_mesh.h"

#include "dual/hex_complex.h"

namespace hexwright::dual {

/// Positions on the finest lattice: the mean of the places of a vertex's hexes, moved into the
/// planes of the domain's boundary that the vertex lies on.
IdVector<VertId, Vec3> compute_positions(const HexComplex& complex);

/// Bit a is set when the vertex may not move along axis a: it lies on a boundary plane across it.
IdVector<VertId, std::uint8_t> collect_fixed_axes(const HexComplex& complex);

}  // namespace hexwright::dual
