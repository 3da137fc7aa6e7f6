// The trivial hex mesh of the undivided domain: the dual of the root lattice, cut flush with the
// domain's boundary.
#pragma once

#include "dual/domain.h"
#include "dual/hex_complex.h"

namespace hexwright::dual {

/// Fills an empty complex with one or more hexes per lattice vertex of the root cubes.
void build_base_mesh(const Domain& domain, HexComplex& complex);

/// Box domains: one hex per lattice vertex; those on the boundary are half, quarter or eighth
/// cells.
void build_box_base(const Domain& domain, HexComplex& complex);

}  // namespace hexwright::dual
