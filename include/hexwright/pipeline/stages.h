// Stages run alone, with what the pipeline otherwise decides for them.
#pragma once

#include <optional>

#include "hexwright/dual/dual_mesh.h"
#include "hexwright/pipeline/mesh_surface.h"
#include "hexwright/polycube/polycube.h"

namespace hexwright {

/// The adaptive grid that mesh_surface() would start from, with the lattice along the given axes.
/// Of the options, `sizing` and `target` count, but for its placement. Errors: those of
/// prepare_surface and build_grid.
SizingResult size_surface(const TriMesh& surface, const MeshOptions& options,
                          const Context& context);

/// A fit is asked for by what is wished of the surface and of the mesh.
struct FitStageOptions {
  TargetOptions target;
  FitOptions fit;
  int order = 1;  ///< as MeshOptions::order
};

/// A fitted mesh, of second order when that is asked for.
struct FitStageResult {
  FitResult fit;
  std::optional<CurvingReport> curving;
  void to_world(const Similarity& frame);
};

/// fit(), and curve_mesh() on what it made. In the target's coordinates.
FitStageResult run_fit_stage(const HexMesh& background, const Target& target,
                             const FitStageOptions& options, const Context& context);

struct DualStageOptions {
  std::optional<DualMode> mode;  ///< absent: blocks when the grid is paired, else sheets
  bool optimize = true;          ///< untangle and improve vertex positions
};

/// The mode that the options ask for on this grid.
DualMode resolve_dual_mode(const Grid& grid, const DualStageOptions& options);

/// As build_dual(). What the mode needs is checked first: a message that names the step to run is
/// worth more than a dual that fails half-way. Errors: BadGeometry when the grid is not balanced,
/// and those of build_dual.
DualResult run_dual_stage(const Grid& grid, const DualStageOptions& options,
                          const Context& context);

}  // namespace hexwright
