// Completion as an integer program: the paper's own formulation, kept as an oracle.
//
// In the library hexwright::ilp, built when HiGHS is found; the core library needs no solver. From
// an installed package: find_package(hexwright COMPONENTS ilp).
//
// Based on: Pitzalis et al. 2021, section 4 (one program per depth, 308 exclusions per vertex).
// Differs: the whole hierarchy can also be one program, which certifies how far completion is from
// the coarsest possible grid (docs/algorithms/pairing.md).
#pragma once

#include <string>

#include "hexwright/base/context.h"
#include "hexwright/grid/complete.h"

namespace hexwright {

enum class IlpScope {
  Depth,     ///< one program per depth, from the deepest up
  Hierarchy  ///< one program for all depths: the least number of cells there is
};

struct IlpOptions {
  Balance balance = Balance::Weak;
  IlpScope scope = IlpScope::Depth;
  double time_limit_seconds = 60;  ///< for all programs together
};

struct IlpResult {
  Grid grid;
  std::size_t num_cells = 0;
  std::size_t lower_bound = 0;  ///< on the leaves; Depth: of the depth-wise optimum found
  bool is_optimal = false;      ///< false when the time limit left a gap
};

/// Block pairing by integer programming. For small grids: the program grows by about a hundred rows
/// per cell. Errors: as complete() with blocks, so BadArgument for relaxed balance, under which
/// blocks are not defined; OutOfResources when the solver fails or finds no solution in time.
IlpResult complete_by_ilp(const Grid& grid, const IlpOptions& options, const Context& context);

/// Name and version of the solver.
std::string ilp_solver_name();

}  // namespace hexwright
