// The stages in order, and the loop that refines the grid where the fit missed the surface.
#include "hexwright/pipeline/mesh_surface.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/geometry/pose.h"
#include "hexwright/geometry/similarity.h"

#include "pipeline/loop.h"
#include "pipeline/stage_log.h"

namespace hexwright {
namespace {

/// Options that follow from others, for a surface in unit coordinates.
MeshOptions resolve_options(MeshOptions options, double diagonal) {
  options.judge.features = features_for_sizing(options.fit.features, diagonal);
  options.fit.features.min_length = options.judge.features.min_length;
  if (options.fit.carve.side != Side::Inside) options.judge.distance.quads = JudgedQuads::Labeled;
  const double threshold = options.refine_threshold * options.sizing.tolerance;
  options.judge.distance.hot_threshold = threshold;
  options.even.max_cells = std::min(options.even.max_cells, options.max_hexes);
  if (options.sizing.sizing != Sizing::Deviation) options.even.transition_cost = 0;  // the paper's
  options.judge.distance.spacing = std::min(options.judge.distance.spacing, 1.5 * threshold);
  return options;
}

void record_sizing(const SizingResult& sizing, StageRecord& stage) {
  stage.counts["cells"] = static_cast<double>(sizing.grid.num_cells());
  stage.counts["deepest level"] = sizing.reached_level;
  for (std::size_t r = 0; r < sizing.splits_by_reason.size(); ++r)
    stage.counts[std::string("splits: ") + kSplitReasons[r]] =
        static_cast<double>(sizing.splits_by_reason[r]);
}

/// What no cell could resolve is no part.
PrepareOptions resolve_prepare(const MeshOptions& options) {
  PrepareOptions prepare = options.prepare;
  if (prepare.min_part < 0)
    prepare.min_part = options.sizing.sizing == Sizing::Deviation ? options.sizing.tolerance : 0.0;
  return prepare;
}

/// How close to one plane, in the unit frame, the vertices of a turned plane face must lie to be
/// put exactly on it: files in single precision leave some 1e-7.
constexpr double kPlaneTolerance = 1e-6;

/// Turns a surface in unit coordinates along its faces; `frame` turns with it.
void turn_along_faces(const MeshOptions& options, TriMesh& surface, Similarity& frame) {
  if (options.placement == Placement::AsGiven || options.fit.carve.side != Side::Inside) return;
  frame.pose = find_pose(surface);
  surface = turn_surface(surface, frame.pose, kPlaneTolerance);
}

/// The user's creases are given in the world.
void map_to_unit(const Similarity& frame, FeatureOptions& options) {
  for (auto& segment : options.extra_segments)
    for (Vec3& p : segment) p = frame.to_unit(p);
}

void warn_unmatched(const FeatureGraph& features, const Context& context) {
  if (features.num_unmatched_segments > 0)
    context.warn(
        fmt::format("{} of the feature edges given are no edges of the surface and are left out",
                    features.num_unmatched_segments));
}

/// Completes the a-priori grid; when the result breaks the budget, builds the grid again one level
/// less deep.
CompleteResult complete_within_budget(const RoundInput& input, const FeatureGraph& features,
                                      MeshResult& result) {
  SizingOptions sizing = input.options.sizing;
  // The sizing takes shares of the box's diagonal, which turning has changed.
  const double turned = input.tree.diagonal() / input.tree.box().diagonal();
  sizing.tolerance *= turned;
  sizing.min_edge *= turned;
  while (true) {
    result.sizing = run_stage(result.stages, "sizing", input.context, [&] {
      return build_grid(input.tree.surface(), features, sizing, input.context);
    });
    record_sizing(result.sizing, result.stages.back());
    CompleteResult completed = run_stage(result.stages, "complete", input.context,
                                         [&] { return even_out(input, result.sizing.grid); });
    result.stages.back().counts["cells"] = static_cast<double>(completed.grid.num_cells());
    if (completed.grid.num_cells() <= input.options.max_hexes) return completed;
    if (result.sizing.reached_level <= sizing.min_level)
      throw Error(ErrorCode::OutOfResources,
                  fmt::format("the grid needs {} cells, more than the budget of {}, already at "
                              "level {}; raise the budget or lower the minimum level",
                              completed.grid.num_cells(), input.options.max_hexes,
                              result.sizing.reached_level));
    sizing.max_level = result.sizing.reached_level - 1;
    input.context.warn(fmt::format(
        "the grid would have {} cells, more than the budget of {}: its levels end at {} instead "
        "of {}",
        completed.grid.num_cells(), input.options.max_hexes, sizing.max_level,
        result.sizing.reached_level));
  }
}

GridFrame to_world(const Similarity& frame, const GridFrame& grid) {
  return {frame.to_world(grid.origin), frame.length_to_world(grid.root_size)};
}

void map_to_world(const Similarity& frame, MeshResult& result) {
  const double s = frame.scale();
  auto& positions = result.mesh.positions.raw();
  parallel_for(positions.size(),
               [&](std::size_t i) { positions[i] = frame.to_world(positions[i]); });
  result.grid.frame = to_world(frame, result.grid.frame);
  result.sizing.grid.frame = to_world(frame, result.sizing.grid.frame);
  Verdict& v = result.verdict;
  v.quality.total_volume *= s * s * s;
  if (v.features) {
    v.features->total_length *= s;
    for (CurveRecovery& c : v.features->curves) c.length *= s;
    for (MissedFeature& m : v.features->missed) {
      m.position = frame.to_world(m.position);
      m.distance *= s;
    }
  }
  if (v.distance) {
    v.distance->worst_on_surface = frame.to_world(v.distance->worst_on_surface);
    v.distance->worst_on_mesh = frame.to_world(v.distance->worst_on_mesh);
    for (Vec3& p : v.distance->hot) p = frame.to_world(p);
  }
  FitReport& f = result.fit;
  f.curve_length *= s;
  f.curve_length_mapped *= s;
  for (CurveOutcome& c : f.curves) c.max_residual *= s;
  for (Vec3& p : f.carve.lost) p = frame.to_world(p);
  for (Vec3& p : f.carve.thin) p = frame.to_world(p);
  for (Miss& m : f.misses) {
    m.position = frame.to_world(m.position);
    m.distance *= s;
  }
}

/// Rounding to the input's coordinates can undo validity when the model is far from the origin.
void check_after_mapping(const Similarity& frame, MeshResult& result) {
  HexMesh unit = result.mesh;  // judged at unit scale: squares of huge or tiny ones overflow
  for (Vec3& p : unit.positions) p = frame.to_unit(p);
  const std::size_t num_inverted = summarize_quality(unit).num_inverted;
  if (result.verdict.quality.num_inverted == 0 && num_inverted > 0)
    result.failures.push_back(fmt::format(
        "{} hexes are inverted only by rounding to the input's coordinates, which are too far "
        "from the origin for the model's size; move the model nearer to the origin",
        num_inverted));
}

void take_round(Round&& round, MeshResult& result) {
  result.mesh = std::move(round.fit.mesh);
  result.fit = std::move(round.fit.report);
  result.grid = std::move(round.grid);
  result.verdict = std::move(round.verdict);
  result.complete = std::move(round.complete);
  result.dual = round.dual;
  for (StageRecord& stage : round.stages) result.stages.push_back(std::move(stage));
}

/// Passes everything on, and keeps each warning once.
Context collect_warnings(const Context& caller, std::vector<std::string>& warnings) {
  Context context = caller;
  context.on_warning = [&caller, &warnings](std::string_view message) {
    if (std::find(warnings.begin(), warnings.end(), message) != warnings.end()) return;
    warnings.emplace_back(message);
    caller.warn(message);
  };
  return context;
}

}  // namespace

MeshResult mesh_surface(const TriMesh& surface, const MeshOptions& given, const Context& caller) {
  const Stopwatch clock;
  const auto watch = caller.watch();
  MeshResult result;
  const Context context = collect_warnings(caller, result.warnings);

  // Clean and orient, then normalise position and scale.
  PreparedSurface prepared = run_stage(result.stages, "prepare", context, [&] {
    return prepare_surface(surface, resolve_prepare(given), context);
  });
  result.surface = std::move(prepared.diagnosis);
  result.stages.back().counts["triangles"] = static_cast<double>(prepared.mesh.num_tris());
  Similarity frame = compute_unit_frame(prepared.mesh);
  prepared.mesh = to_unit(prepared.mesh, frame);
  const double diagonal = bounding_box(prepared.mesh).diagonal();
  turn_along_faces(given, prepared.mesh, frame);
  result.pose = frame.pose;

  // What the surface is like.
  MeshOptions options = given;
  map_to_unit(frame, options.fit.features);
  options = resolve_options(std::move(options), diagonal);
  const SurfaceTree tree = run_stage(result.stages, "surface tree", context, [&] {
    return SurfaceTree(std::move(prepared.mesh), diagonal);
  });
  const FeatureGraph features = run_stage(result.stages, "features", context, [&] {
    // Once for all rounds: every fit and every judgement extracts the features again.
    FeatureOptions& judged = options.judge.features;
    judged.creases = find_creases(tree, judged.crease_angle);
    options.fit.features.creases = judged.creases;
    return extract_features(tree, judged);
  });
  warn_unmatched(features, context);
  result.stages.back().counts["curves"] = static_cast<double>(features.curves.size());
  result.stages.back().counts["corners"] = static_cast<double>(features.corners.size());
  const ExpectedTopology expected = find_expected_topology(tree);
  options.fit.carve.expected = expected;
  // All of a sound surface bounds the solid: no sample need be excused.
  if (expected.is_known) options.judge.distance.solid_only = false;

  // Grid, hexes, fit; again where the fit missed.
  const RoundInput input{tree, options, expected, context, &features};
  CompleteResult completed = complete_within_budget(input, features, result);
  Round best = refine_where_missed(input, std::move(completed), result);
  apply_gate(input, best, result);
  take_round(std::move(best), result);
  map_to_world(frame, result);
  check_after_mapping(frame, result);
  result.seconds = clock.seconds();
  return result;
}

}  // namespace hexwright
