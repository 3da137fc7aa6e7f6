// The main job: surface in, verified all-hex mesh out.
//
// Based on: Pitzalis et al. 2021 (grid, pairing, dual); docs/algorithms/sizing.md (the loop that
// refines where the fit missed).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/base/stage_record.h"
#include "hexwright/cad/cad_surface.h"
#include "hexwright/curving/curve_mesh.h"
#include "hexwright/dual/dual_mesh.h"
#include "hexwright/fit/fit.h"
#include "hexwright/geometry/exact_shape.h"
#include "hexwright/grid/complete.h"
#include "hexwright/grid/even_levels.h"
#include "hexwright/grid/sizing.h"
#include "hexwright/layers/layers.h"
#include "hexwright/pipeline/size_wishes.h"
#include "hexwright/quality/edge_lengths.h"
#include "hexwright/quality/judge.h"
#include "hexwright/target/target.h"

namespace hexwright {

/// Wishes only; what follows from them, and from the surface, is in the plan (pipeline/plan.h).
struct MeshOptions {
  TargetOptions target = {
      .placement = Placement::Faces,
      .features = {},
      .prepare = {.min_part = -1, .min_gap = -1}};  ///< below 0: the tolerance, a fifth of it
  SizingOptions sizing;
  bool is_tolerance_given = false;  ///< else `sizes` may raise sizing.tolerance
  SizeWishes sizes;
  CompleteOptions complete;
  EvenOptions even;  ///< with Sizing::Deviation; off with the paper's
  FitOptions fit;    ///< its tolerance is the sizing's (plan.h)
  /// Of the elements: 2 gives edges nodes on the surface (see curving/curve_mesh.h), and puts the
  /// vertices of curved patches there.
  int order = 1;

  /// Bodies nearer to each other than this share of the diagonal, or touching, are meshed each by
  /// itself, with vertices of its own: the gap stays. Negative: twice the tolerance; 0: never.
  double gap = -1;
  CadSurfaceOptions cad;  ///< of CAD files: see mesh_cad()
  /// What the surface's triangles stand for, in its coordinates, where it is known: the mesh's
  /// boundary vertices are put onto it in the end. May be null.
  std::shared_ptr<const ExactShape> exact;
  LayersOptions layers;  ///< along walls, in the mesh of the best round

  int max_rounds = 6;              ///< refine where the fit missed; 0 = a single pass
  double refine_threshold = 0.85;  ///< leaves farther off than this share of the tolerance split
  /// The mean two-way distance that the loop is content with, as a share of the tolerance: where
  /// it alone is missed all cells become a little smaller. 0 = the maximum alone counts.
  double mean_share = 0.06;
  double min_quality = 0.2;  ///< least scaled Jacobian the loop is content with
  double edge_tolerance = JudgeOptions{}.edge_tolerance;      ///< share of the diagonal
  double corner_tolerance = JudgeOptions{}.corner_tolerance;  ///< share of the diagonal
  /// Share of the feature length within edge_tolerance of mesh edges that the loop is content
  /// with; it refines along curves that are followed too coarsely, and along others until their
  /// cells are short enough for a path. 0 = not for features.
  double min_feature_share = 0.98;
  int loop_extra_levels = 3;  ///< the loop may go so much deeper than sizing.max_level
  /// The result has no more hexes than this, and is the best that they allow; 0 = as many as the
  /// tolerance takes. The guards below, which only say where a run ends, follow from it.
  std::size_t most_hexes = 0;
  std::size_t max_hexes = 2'000'000;  ///< of one background mesh; at least four times most_hexes
  /// Of the background meshes of all rounds together, beyond which there is no further round; a
  /// quarter of it for open and overlapping surfaces, which the warning says. Counts, not seconds,
  /// so that results do not depend on the machine. At least 1.4 times most_hexes.
  std::size_t max_loop_hexes = 700'000;
};

/// Sets the options of a single pass: a stricter a-priori criterion instead of the loop.
void use_single_pass(MeshOptions& options);

/// What one round of the loop reached.
struct RoundRecord {
  std::size_t num_cells = 0;                   ///< of the completed grid
  std::size_t num_background = 0;              ///< hexes before carving
  std::size_t num_hexes = 0;                   ///< of the result
  double max_distance = 0, mean_distance = 0;  ///< two-way, shares of the diagonal
  double min_scaled_jacobian = 0, avg_scaled_jacobian = 0;
  std::size_t num_components = 0;
  long genus = 0;
  bool is_valid = false;         ///< topology valid, nothing inverted
  std::size_t num_inverted = 0;  ///< hexes
  bool is_topology_met = true;   ///< the surface's components and genus, where it tells them
  std::size_t num_marked = 0;    ///< leaves split for the next round
  double scale = 1;              ///< of all cells for the next round
  double seconds = 0;
};

/// How the boundary vertices came onto the exact shape.
struct ExactReport {
  std::size_t num_verts = 0;  ///< on the boundary
  std::size_t num_exact = 0;  ///< on the exact shape in the end
  std::size_t num_short = 0;  ///< stopped on the way there, for the hexes around
  /// Farthest from where it belongs, of those two, before and after; shares of the diagonal. The
  /// rest of the vertices has no place on the exact shape within a third of an edge.
  double max_before = 0, max_after = 0;
};

struct MeshResult {
  HexMesh mesh;
  Verdict verdict;
  SurfaceDiagnosis surface;
  double diagonal = 0;  ///< that shares are of, world units
  /// How the part was turned to lie along the lattice (see Placement): the rows are the axes, in
  /// the world, along which the cells of `grid` and `sizing.grid` stand on their frame's origin.
  Rotation pose;
  /// Per hex: the depth of the grid's cell that its centre lies in; 0 outside of the grid.
  IdVector<HexId, std::int8_t> levels;
  Grid grid;            ///< the completed grid of the best round
  SizingResult sizing;  ///< the a-priori grid
  CompleteReport complete;
  DualReport dual;
  FitReport fit;
  std::optional<CurvingReport> curving;  ///< of a mesh of second order
  std::optional<ExactReport> exact;      ///< with MeshOptions::exact
  LayersReport layers;
  /// Per hex: the number of its wall layer, counted from the wall, 0 = in none; empty when none
  /// were asked for.
  IdVector<HexId, std::int32_t> layer;
  EdgeLengths edges;
  double size_asked = 0;  ///< the largest edge that was asked for everywhere; 0 = none was
  double size_used = 0;   ///< of the lattice, so that edges keep to it; with `cells` the one found
  /// The wishes with what follows from them: lengths in the surface's unit, the distance goal as
  /// asked or as sizes allow.
  MeshOptions options;
  std::vector<StageRecord> stages;  ///< those of the best round, after the common ones
  std::vector<RoundRecord> rounds;
  int num_rounds = 0;  ///< refinements after the first fit
  int best_round = 0;
  bool is_limited = false;  ///< by MeshOptions::most_hexes: a finer mesh was refused for its hexes
  double seconds = 0;       ///< wall clock of everything
  std::vector<std::string> warnings;
  std::vector<std::string> failures;  ///< why the mesh misses the gate; empty = done and valid

  void to_world(const Similarity& frame);
};

/// The gate: topology valid, nothing inverted, the surface's number of components, and a two-way
/// distance of at most twice the tolerance (of Deviation sizing; the paper's has no such goal).
/// What else falls short of the options is a warning.
///
/// Works in normalised coordinates, so that tiny, huge and far models are all alike; the result is
/// in the input's. Same result for any thread count.
/// Errors: those of prepare_surface; OutOfResources when the budget leaves no mesh.
MeshResult mesh_surface(const TriMesh& surface, const MeshOptions& options, const Context& context);

}  // namespace hexwright
