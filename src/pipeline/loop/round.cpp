// Runs one round.
#include "pipeline/loop/round.h"

#include <algorithm>

#include "base/stage_log.h"
#include "pipeline/loop/demands.h"
#include "pipeline/loop/feature_misses.h"
#include "pipeline/loop/thin_misses.h"

namespace hexwright {
namespace {

void count(StageRecord& stage, const std::string& name, std::size_t value) {
  stage.counts[name] = static_cast<double>(value);
}

RoundRecord make_record(const RoundInput& input, const Round& round, double seconds) {
  RoundRecord record;
  record.num_cells = round.grid.num_cells();
  record.num_background = round.dual.num_hexes;
  record.num_hexes = round.fit.mesh.num_hexes();
  record_shape(round, record);
  record.num_components = round.verdict.topology.num_components;
  record.genus = round.verdict.topology.genus();
  record.is_valid = round.verdict.is_valid();
  record.num_inverted = round.verdict.quality.num_inverted;
  record.is_topology_met = has_expected_topology(input, round);
  record.seconds = seconds;
  return record;
}

/// Share of the surface's feature length with paths in the mesh, from which on curves are refined
/// for beyond the gate of distance too. With less, that mesh is too coarse to tell which curves the
/// next one will follow by itself.
constexpr double kMappedShare = 0.9;

/// Where the curves call for finer cells.
void find_refinable_features(const RoundInput& input, Round& round) {
  if (!misses_features(input, round)) return;
  const FeatureRecovery& recovery = *round.verdict.features;
  const bool is_mapped =
      round.fit.report.curve_length_mapped >= kMappedShare * recovery.total_length;
  if (!is_mapped && !is_within_gate(input, round)) return;
  const double tolerance = input.options.edge_tolerance * input.target.diagonal();
  round.refinable_features =
      find_refinable_features(round.grid, recovery, tolerance, deepest_level(input.options));
  round.crowded_features =
      find_crowded_misses(round.grid, input.target.surface(), input.target.features, recovery,
                          kLeastFeatureCell * tolerance);
  for (const SizedPlace& place : round.crowded_features)
    round.refinable_features.push_back(place.position);
}

}  // namespace

void record_shape(const Round& round, RoundRecord& record) {
  if (round.verdict.distance) {
    record.max_distance = round.verdict.distance->max_two_way();
    record.mean_distance = round.verdict.distance->mean_two_way();
  }
  record.min_scaled_jacobian = round.verdict.quality.min_scaled_jacobian;
  record.avg_scaled_jacobian = round.verdict.quality.avg_scaled_jacobian;
}

bool is_within_gate(const RoundInput& input, const Round& round) {
  return round.verdict.is_valid() &&
         max_distance(round) <= kGateFactor * input.options.sizing.tolerance;
}

int deepest_level(const MeshOptions& options) {
  return std::min(options.sizing.max_level + options.loop_extra_levels, kMaxGridLevel);
}

void curve_round(const RoundInput& input, Round& round, const ExactShape* exact) {
  if (input.options.order < 2 || !round.fit.parts || round.fit.mesh.num_hexes() == 0) return;
  const CurvingTarget target = {input.target.tree, *round.fit.parts, input.plan.fit.carve.side,
                                exact, input.target.frame};
  round.curving = run_stage(round.stages, "curve", input.context,
                            [&] { return curve_mesh(round.fit.mesh, target, input.context); });
}

/// Stages log their own counts, so that a report tells which of them made or lost hexes.
Round run_round(const RoundInput& input, CompleteResult completed) {
  const Stopwatch clock;
  const StagePlan& plan = input.plan;
  Round round;
  round.grid = std::move(completed.grid);
  round.complete = std::move(completed.report);

  DualResult dual = run_stage(round.stages, "dual", input.context,
                              [&] { return build_dual(round.grid, plan.dual, input.context); });
  round.dual = dual.report;
  round.dual.num_hexes = dual.mesh.num_hexes();
  count(round.stages.back(), "hexes", dual.mesh.num_hexes());
  count(round.stages.back(), "vertices", dual.mesh.num_verts());

  round.fit = run_stage(round.stages, "fit", input.context, [&] {
    return fit_unlifted(dual.mesh, input.target, plan.fit, input.context);
  });
  count(round.stages.back(), "hexes", round.fit.mesh.num_hexes());
  count(round.stages.back(), "carved", round.fit.report.num_hexes_carved);
  count(round.stages.back(), "padded", round.fit.report.num_hexes_padded);

  curve_round(input, round);
  if (round.fit.mesh.num_hexes() > 0)
    round.verdict = run_stage(round.stages, "judge", input.context, [&] {
      return judge(round.fit.mesh, input.target, plan.judge, input.context);
    });
  else
    round.verdict.failures.push_back(
        "nothing of the object was kept: its parts are thinner than the grid's cells");
  find_refinable_features(input, round);
  round.thin_misses = find_thin_misses(input, round);
  round.record = make_record(input, round, clock.seconds());
  return round;
}

Round lift_round(const RoundInput& input, Round round) {
  if (!round.fit.memory) return round;
  Round lifted = round;
  lifted.fit = run_stage(lifted.stages, "lift", input.context, [&] {
    return lift_fit(*round.fit.memory, input.target, input.plan.fit, input.context);
  });
  lifted.curving.reset();
  curve_round(input, lifted);
  lifted.verdict = run_stage(lifted.stages, "judge", input.context, [&] {
    return judge(lifted.fit.mesh, input.target, input.plan.judge, input.context);
  });
  const bool is_kept = meets_no_less(input, round, lifted);
  count(lifted.stages.back(), "lift kept", is_kept ? 1 : 0);
  record_shape(lifted, lifted.record);
  if (is_kept) return lifted;
  round.stages = std::move(lifted.stages);  // the time is spent
  round.fit.memory.reset();
  return round;
}

Round layer_round(const RoundInput& input, Round round, MeshResult& result) {
  if (input.options.layers.empty() || round.fit.mesh.num_hexes() == 0) return round;
  if (round.verdict.quality.num_inverted > 0) return round;  // no result with layers either
  round.fit.mesh.mid_nodes.reset();
  LayersResult layered = run_stage(round.stages, "layers", input.context, [&] {
    return add_layers(round.fit.mesh, input.target, input.options.layers, input.context);
  });
  round.fit.mesh = std::move(layered.mesh);
  result.layer = std::move(layered.layer);
  result.layers = std::move(layered.report);
  count(round.stages.back(), "hexes", round.fit.mesh.num_hexes());
  curve_round(input, round);
  round.verdict = run_stage(round.stages, "judge", input.context, [&] {
    return judge(round.fit.mesh, input.target, input.plan.judge, input.context);
  });
  return round;
}

}  // namespace hexwright
