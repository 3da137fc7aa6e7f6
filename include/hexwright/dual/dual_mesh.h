// From an adaptive grid to a conforming hex mesh, by pillows around the core planes of split nodes.
//
// Based on: the dual of Pitzalis et al. 2021, section 5, rebuilt without templates
// (docs/algorithms/dual.md).
#pragma once

#include "hexwright/base/context.h"
#include "hexwright/grid/grid.h"
#include "hexwright/mesh/hex_mesh.h"

namespace hexwright {

enum class DualMode {
  Blocks,  ///< the grid is paired: mid-planes close around its 2x2x2 blocks
  Sheets   ///< the grid is only balanced: each axis closes on its own, one-cell-wide partners
};

struct DualOptions {
  DualMode mode = DualMode::Blocks;
  bool inset = false;  ///< drop the half cells at the domain's border (polycubes of the reference)
  bool optimize = true;  ///< untangle and improve vertex positions; boundary vertices slide in the
                         ///< domain's faces
};

struct DualReport {
  std::size_t num_hexes = 0;
  std::size_t num_cap_hexes = 0;     ///< hexes that close a pillow
  std::size_t num_inverted_raw = 0;  ///< before optimisation
  std::size_t num_freed_verts = 0;   ///< boundary vertices moved off the boundary to untangle; only
                                     ///< at twisted corners of domains that are not boxes
  double min_scaled_jacobian_raw = 0, min_scaled_jacobian = 0, avg_scaled_jacobian = 0;
};

struct DualResult {
  HexMesh mesh;  ///< in world space
  DualReport report;
};

/// Errors: BadArgument when the grid is not paired in Blocks mode (run complete() first),
/// BadGeometry when the domain is not a manifold union of cubes.
DualResult build_dual(const Grid& grid, const DualOptions& options, const Context& context);

/// How many hexes build_dual() makes of the grid (without `inset`), by its topology alone: a tenth
/// of the time. Same errors.
std::size_t count_dual_hexes(const Grid& grid, DualMode mode, const Context& context);

}  // namespace hexwright
