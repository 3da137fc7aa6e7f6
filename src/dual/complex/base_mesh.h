// The trivial hex mesh of the undivided domain: the dual of the root lattice, cut flush with the
// domain's boundary.
#pragma once

#include "dual/complex/hex_complex.h"
#include "dual/domain/domain.h"

namespace hexwright::dual {

enum class BaseStatus {
  Ok,
  TooThin  ///< a cell touches the boundary on too many sides: split every root once and try again
};

/// Fills an empty complex with one or more hexes per lattice vertex of the root cubes. Throws
/// Error{BadGeometry} when two roots touch along an edge only while connected around one of its
/// ends.
BaseStatus build_base_mesh(const Domain& domain, HexComplex& complex);

/// Box domains: one hex per lattice vertex; those on the boundary are half, quarter or eighth
/// cells.
void build_box_base(const Domain& domain, HexComplex& complex);

/// Any union of roots.
BaseStatus build_general_base(const Domain& domain, HexComplex& complex);

}  // namespace hexwright::dual
