// The topology of the dual mesh of a grid: all of the stage but positions.
#pragma once

#include "hexwright/base/context.h"
#include "hexwright/dual/dual_mesh.h"

#include "dual/complex/hex_complex.h"

namespace hexwright::dual {

/// Time and memory linear in the hexes. `used_grid` receives the grid whose lattice the places
/// refer to: `grid`, or `grid` with every root split when its domain is a single root thick
/// somewhere. Errors: see build_dual().
HexComplex build_complex(const Grid& grid, DualMode mode, const Context& context, Grid& used_grid);

/// The same cells over roots of half the edge; root cubes that are leaves are split.
Grid split_roots(const Grid& grid);

}  // namespace hexwright::dual
