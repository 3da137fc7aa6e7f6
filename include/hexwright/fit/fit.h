// Fits a hex mesh to a surface with sharp features; no element is ever inverted.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/fit/carve.h"
#include "hexwright/geometry/surface_parts.h"
#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/target/target.h"

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
  double snap_quality =
      0.2;  ///< boundary vertices move to their targets while the scaled Jacobian stays above
  PatchVerts patch_verts = PatchVerts::Balanced;
  /// Two-way distance that the mesh may have, a share of the surface's diagonal: around hexes below
  /// lift_goal, boundary vertices leave the surface within it, as far as that raises the least
  /// scaled Jacobian.
  double tolerance = 0.005;
  double lift_goal = 0.5;  ///< 0, or vertices on the surface: they stay where they belong ...
  bool lifts_off_surface = false;  ///< ... unless this is wished: only the balance is given up then
};

/// What became of one feature curve.
struct CurveOutcome {
  CurveId curve;
  bool is_mapped = false;
  double max_residual = 0;  ///< world units, when mapped
  std::string reason;       ///< why it was dropped

  void to_world(const Similarity& frame) { max_residual = frame.length_to_world(max_residual); }
};

/// A place where the surface was not reached.
struct Miss {
  Vec3 position;
  double distance = 0;  ///< world units

  void to_world(const Similarity& frame) {
    position = frame.to_world(position);
    distance = frame.length_to_world(distance);
  }
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

  void to_world(const Similarity& frame);
};

struct FitMemory;  // of the fit's last passes

struct FitResult {
  HexMesh mesh;  ///< labels carry patches, curves and corners; empty when nothing was kept
  FitReport report;
  /// What lift_fit() goes on from; empty when there is nothing to lift.
  std::shared_ptr<const FitMemory> memory;
  std::shared_ptr<const SurfaceParts> parts;  ///< of the labels; null for an empty mesh

  void to_world(const Similarity& frame);
};

/// Requires: every corner of every hex of `background` has a positive Jacobian.
/// Guarantees: so has the result. Errors: BadArgument when the requirement fails (names the hex).
///
/// Mesh and result are in the target's coordinates. Features shorter than both the target's least
/// length and what the mesh resolves are left out; those that are longer and still do not fit are
/// reported.
FitResult fit(const HexMesh& background, const Target& target, const FitOptions& options,
              const Context& context);
/// One-shot: the surface in any units, the background, the result and its report in the same.
FitResult fit(const HexMesh& background, const TriMesh& surface, const TargetOptions& target,
              const FitOptions& options, const Context& context);

/// The same in two steps, for callers that look at many fits and keep one: boundary vertices stay
/// where they belong ...
FitResult fit_unlifted(const HexMesh& background, const Target& target, const FitOptions& options,
                       const Context& context);
/// ... and leave it within the tolerance where that raises a least scaled Jacobian below the goal;
/// the first step's mesh where the least falls (by more than 5% where the sum of squared shortfalls
/// below the goal falls too) and no more hexes are proven.
/// Requires a memory, of a fit to the same target with the same options.
FitResult lift_fit(const FitMemory& memory, const Target& target, const FitOptions& options,
                   const Context& context);

}  // namespace hexwright
