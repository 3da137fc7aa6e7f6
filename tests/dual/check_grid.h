// Meshes a grid and checks everything the dual stage promises; shrinks what fails.
#pragma once

#include "hexwright/dual/dual_mesh.h"

#include "dual/random_grids.h"

namespace hexwright::test {

/// Do four roots meet at a vertex in a twisted path? Such corners are chamfered on purpose.
bool has_chiral_corner(const std::vector<LatticeCoord>& roots);

/// Empty when the grid's mesh is valid, fills its domain and has no inverted element; in blocks
/// mode on a box not even before optimisation. Domains that are pinched along an edge must be
/// rejected.
std::string find_dual_problem(const SplitTree& tree, DualMode mode);

/// The smallest grid found by undoing splits that still shows a problem, as C++ to paste in a test.
std::string minimize_failure(const SplitTree& tree, DualMode mode);

struct GridFamily {
  SplitTree (*make_tree)(unsigned seed, const std::vector<LatticeCoord>& roots);
  std::vector<LatticeCoord> (*make_domain)(unsigned seed);
  DualMode mode;
};

/// Expects no problem for the seeds first .. last - 1; prints minimised failures.
void check_random_grids(const GridFamily& family, unsigned first, unsigned last);

}  // namespace hexwright::test
