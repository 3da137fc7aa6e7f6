// Runs one round and prepares the next.
#include "pipeline/round.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/feature_misses.h"
#include "pipeline/stage_log.h"

namespace hexwright {
namespace {

DualMode dual_mode_of(Pairing pairing) {
  return pairing == Pairing::Blocks || pairing == Pairing::Octree ? DualMode::Blocks
                                                                  : DualMode::Sheets;
}

void count(StageRecord& stage, const std::string& name, std::size_t value) {
  stage.counts[name] = static_cast<double>(value);
}

RoundRecord make_record(const Round& round, double seconds) {
  RoundRecord record;
  record.num_cells = round.grid.num_cells();
  record.num_background = round.dual.num_hexes;
  record.num_hexes = round.fit.mesh.num_hexes();
  if (round.verdict.distance) {
    record.max_distance = round.verdict.distance->max_two_way();
    record.mean_distance = round.verdict.distance->mean_two_way();
  }
  record.min_scaled_jacobian = round.verdict.quality.min_scaled_jacobian;
  record.avg_scaled_jacobian = round.verdict.quality.avg_scaled_jacobian;
  record.num_components = round.verdict.topology.num_components;
  record.genus = round.verdict.topology.genus();
  record.seconds = seconds;
  return record;
}

/// By the boundary and not by the hexes: cavities count as components of it too.
bool has_expected_topology(const RoundInput& input, const Round& round) {
  if (!input.expected.is_known || input.options.fit.carve.side != Side::Inside) return true;
  const TopologyReport& t = round.verdict.topology;
  return t.num_boundary_components == input.expected.num_components &&
         t.boundary_euler_characteristic == input.expected.euler_characteristic;
}

/// The tolerance for distances is at most so many times the one for features (the default is five):
/// who asks for a coarse mesh does not pay for close curves.
constexpr double kMaxFeatureFactor = 5.001;

double feature_share(const Round& round) {
  return round.verdict.features ? round.verdict.features->length_share : 1;
}

/// Whether too little of the curves is followed.
bool misses_features(const RoundInput& input, const Round& round) {
  const MeshOptions& options = input.options;
  return round.verdict.features && feature_share(round) < options.min_feature_share &&
         options.sizing.tolerance <= kMaxFeatureFactor * options.judge.edge_tolerance;
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
  const double tolerance = input.options.judge.edge_tolerance * input.tree.diagonal();
  round.refinable_features =
      find_refinable_features(round.grid, recovery, tolerance, deepest_level(input.options));
  if (!input.features) return;
  round.crowded_features = find_crowded_misses(round.grid, input.tree.surface(), *input.features,
                                               recovery, kLeastFeatureCell * tolerance);
  for (const SizedPlace& place : round.crowded_features)
    round.refinable_features.push_back(place.position);
}

double max_distance(const Round& round) {
  return round.verdict.distance ? round.verdict.distance->max_two_way() : 1;
}

double mean_distance(const Round& round) {
  return round.verdict.distance ? round.verdict.distance->mean_two_way() : 1;
}

bool misses_mean(const RoundInput& input, const Round& round) {
  const double goal = mean_goal(input.options);
  return goal > 0 && mean_distance(round) > goal;
}

}  // namespace

int deepest_level(const MeshOptions& options) {
  return std::min(options.sizing.max_level + options.loop_extra_levels, kMaxGridLevel);
}

/// Stages log their own counts, so that a report tells which of them made or lost hexes.
Round run_round(const RoundInput& input, CompleteResult completed) {
  const Stopwatch clock;
  const MeshOptions& options = input.options;
  Round round;
  round.grid = std::move(completed.grid);
  round.complete = std::move(completed.report);

  DualOptions dual_options = options.dual;
  dual_options.mode = dual_mode_of(options.complete.pairing);
  DualResult dual = run_stage(round.stages, "dual", input.context,
                              [&] { return build_dual(round.grid, dual_options, input.context); });
  round.dual = dual.report;
  round.dual.num_hexes = dual.mesh.num_hexes();
  count(round.stages.back(), "hexes", dual.mesh.num_hexes());
  count(round.stages.back(), "vertices", dual.mesh.num_verts());

  round.fit = run_stage(round.stages, "fit", input.context,
                        [&] { return fit(dual.mesh, input.tree, options.fit, input.context); });
  count(round.stages.back(), "hexes", round.fit.mesh.num_hexes());
  count(round.stages.back(), "carved", round.fit.report.num_hexes_carved);
  count(round.stages.back(), "padded", round.fit.report.num_hexes_padded);

  if (round.fit.mesh.num_hexes() > 0)
    round.verdict = run_stage(round.stages, "judge", input.context, [&] {
      return judge(round.fit.mesh, input.tree, options.judge, input.context);
    });
  else
    round.verdict.failures.push_back(
        "nothing of the object was kept: its parts are thinner than the grid's cells");
  find_refinable_features(input, round);
  round.record = make_record(round, clock.seconds());
  return round;
}

namespace {

/// The mean falls with the square of the cells' size; aim a little below the goal, for it is an
/// average over shapes that meet the lattice as chance has it.
constexpr double kScaleMargin = 0.98;
constexpr double kLeastScale = 0.6;  // of one step; the next round sees how far it led

/// Whether there is nothing to refine for but the distances.
bool is_content_but_for_distance(const RoundInput& input, const Round& round) {
  return round.verdict.is_valid() && has_expected_topology(input, round) &&
         round.verdict.quality.min_scaled_jacobian >= input.options.min_quality &&
         round.refinable_features.empty();
}

}  // namespace

bool is_content(const RoundInput& input, const Round& round) {
  return is_content_but_for_distance(input, round) && !misses_mean(input, round) &&
         max_distance(round) <= input.options.sizing.tolerance;
}

bool is_within_gate(const RoundInput& input, const Round& round) {
  return round.verdict.is_valid() &&
         max_distance(round) <= kGateFactor * input.options.sizing.tolerance;
}

bool is_out_of_proportion(const RoundInput& input, const Round& round, std::size_t num_next_cells) {
  return is_within_gate(input, round) &&
         static_cast<double>(num_next_cells) >
             kMaxGrowth * static_cast<double>(round.grid.num_cells());
}

/// Lexicographic: what comes first in the array decides first; the numbers below only break ties.
bool is_better(const RoundInput& input, const Round& a, const Round& b) {
  const auto rank = [&](const Round& r) {
    // A mesh beyond the gate is no result, however well shaped: distance to it goes before the
    // rest.
    return std::array<bool, 7>{r.verdict.is_valid(),
                               max_distance(r) <= kGateFactor * input.options.sizing.tolerance,
                               has_expected_topology(input, r),
                               max_distance(r) <= input.options.sizing.tolerance,
                               r.verdict.quality.min_scaled_jacobian >= input.options.min_quality,
                               !misses_features(input, r),
                               !misses_mean(input, r)};
  };
  if (rank(a) != rank(b)) return rank(a) > rank(b);
  if (max_distance(a) > input.options.sizing.tolerance) return max_distance(a) < max_distance(b);
  if (misses_features(input, a)) return feature_share(a) > feature_share(b);
  if (misses_mean(input, a)) return mean_distance(a) < mean_distance(b);
  return a.fit.mesh.num_hexes() < b.fit.mesh.num_hexes();
}

std::optional<double> scale_for_mean(const RoundInput& input, const Round& round) {
  if (!is_content_but_for_distance(input, round) || !misses_mean(input, round)) return {};
  const double goal_share = mean_goal(input.options) / mean_distance(round);
  const double scale = kScaleMargin * std::sqrt(goal_share);
  // A mean that is far off beside a maximum beyond the tolerance comes from places that the grid is
  // too coarse for, not from cells that are a little too large everywhere.
  const double tolerance = input.options.sizing.tolerance;
  const bool mends_maximum = scale >= kLeastScale && max_distance(round) * goal_share <= tolerance;
  if (max_distance(round) > tolerance && !mends_maximum) return {};
  return std::max(kLeastScale, scale);
}

std::vector<char> mark_misses(const RoundInput& input, const Round& round) {
  std::vector<Vec3> points;
  if (round.verdict.distance) points = round.verdict.distance->hot;
  // Tips of wedges are lost on any grid; with the right topology only their distance counts.
  if (!input.expected.is_known || !has_expected_topology(input, round)) {
    const auto& lost = round.fit.report.carve.lost;
    points.insert(points.end(), lost.begin(), lost.end());
  }
  // Two walls of a gap fitted onto the same side of it: finer cells tell them apart.
  for (VertId v : round.verdict.topology.hanging_verts)
    points.push_back(round.fit.mesh.positions[v]);
  const auto& features = round.refinable_features;
  points.insert(points.end(), features.begin(), features.end());
  const int deepest = deepest_level(input.options);
  std::vector<char> marks = mark_cells_with_points(round.grid, points, deepest);
  const bool is_any_marked = std::find(marks.begin(), marks.end(), 1) != marks.end();
  if (is_any_marked || has_expected_topology(input, round)) return marks;
  // Near enough everywhere, and still pierced or bridged: at parts and gaps about a cell thick.
  return mark_cells_with_points(round.grid, round.fit.report.carve.thin, deepest);
}

}  // namespace hexwright
