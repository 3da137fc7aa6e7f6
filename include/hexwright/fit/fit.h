// Fits a hex mesh to a surface with sharp features; no element is ever inverted.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/fit/carve.h"
#include "hexwright/geometry/feature_graph.h"
#include "hexwright/geometry/surface_tree.h"
#include "hexwright/mesh/hex_mesh.h"

namespace hexwright {

enum class Padding {
  Everywhere,  ///< one layer under the whole boundary, then layers under patches that need one
  Selective    ///< layers only where a patch's curves or corners cannot do without
};

/// Where the boundary vertices of smooth curved patches lie. Those of curves are on the curve.
enum class PatchVerts {
  Balanced,  ///< beside the surface, so that quads err to both sides: less than half the distance
  OnSurface
};

struct FitOptions {
  CarveOptions carve;
  bool do_carve = true;  ///< false: the mesh already stands for the object
  Padding padding = Padding::Selective;
  /// What is shorter than the mesh resolves is left out by the stage; above 0, min_length is a
  /// length from which on curves are considered in any mesh, and reported when they do not fit.
  FeatureOptions features;
  double snap_quality =
      0.2;  ///< boundary vertices move to their targets while the scaled Jacobian stays above
  PatchVerts patch_verts = PatchVerts::Balanced;
  /// Two-way distance that the mesh may have, a share of the surface's diagonal: around hexes below
  /// lift_goal, boundary vertices leave the surface within it, as far as that raises the least
  /// scaled Jacobian.
  double tolerance = 0.005;
  double lift_goal = 0.5;  ///< 0 = boundary vertices stay where they belong
};

/// What became of one feature curve.
struct CurveOutcome {
  CurveId curve;
  bool is_mapped = false;
  double max_residual = 0;  ///< world units, when mapped
  std::string reason;       ///< why it was dropped
};

/// A place where the surface was not reached.
struct Miss {
  Vec3 position;
  double distance = 0;  ///< world units
};

struct FitReport {
  CarveResult carve;
  std::size_t num_hexes_carved = 0, num_hexes_padded = 0;
  std::size_t num_curves = 0, num_curves_mapped = 0;
  double curve_length = 0, curve_length_mapped = 0;
  std::size_t num_corners = 0, num_corners_mapped = 0;
  std::vector<CurveOutcome> curves;
  std::vector<Miss> misses;  ///< boundary vertices farther than 2% of their edge length from their
                             ///< target, worst first
  std::vector<HexId> unproven;  ///< hexes of the result whose Jacobian is positive at the corners
                                ///< but not proven positive everywhere inside
  std::vector<std::pair<std::string, double>> seconds;            ///< per pass, by the clock
  std::vector<std::pair<std::string, double>> processor_seconds;  ///< per pass, of all threads
};

struct FitMemory;  // of the fit's last passes

struct FitResult {
  HexMesh mesh;  ///< labels carry patches, curves and corners; empty when nothing was kept
  FitReport report;
  /// What lift_fit() goes on from; empty when there is nothing to lift.
  std::shared_ptr<const FitMemory> memory;
};

/// Requires: every corner of every hex of `background` has a positive Jacobian.
/// Guarantees: so has the result. Errors: BadArgument when the requirement fails (names the hex).
FitResult fit(const HexMesh& background, const SurfaceTree& surface, const FitOptions& options,
              const Context& context);

/// The same in two steps, for callers that look at many fits and keep one: boundary vertices stay
/// where they belong ...
FitResult fit_unlifted(const HexMesh& background, const SurfaceTree& surface,
                       const FitOptions& options, const Context& context);
/// ... and leave it within the tolerance where that raises a least scaled Jacobian below the goal.
/// Requires a memory, of a fit of the same surface with the same options.
FitResult lift_fit(const FitMemory& memory, const SurfaceTree& surface, const FitOptions& options,
                   const Context& context);

}  // namespace hexwright
