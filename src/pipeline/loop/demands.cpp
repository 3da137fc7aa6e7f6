// The demands, a row each.
#include "pipeline/loop/demands.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace hexwright {
namespace {

bool is_inside(const RoundInput& input) { return input.options.fit.carve.side == Side::Inside; }

bool is_valid(const RoundInput&, const Round& round) { return round.verdict.is_valid(); }

/// Two walls of a gap fitted onto the same side of it: finer cells tell them apart.
std::vector<Vec3> places_of_contact(const RoundInput&, const Round& round) {
  std::vector<Vec3> points;
  for (VertId v : round.verdict.topology.hanging_verts)
    points.push_back(round.fit.mesh.positions[v]);
  return points;
}

bool is_near(const RoundInput& input, const Round& round) {
  return max_distance(round) <= kGateFactor * input.options.sizing.tolerance;
}

bool is_within_tolerance(const RoundInput& input, const Round& round) {
  return max_distance(round) <= input.options.sizing.tolerance;
}

double distance_beyond_tolerance(const RoundInput& input, const Round& round) {
  return max_distance(round) - input.options.sizing.tolerance;
}

std::vector<Vec3> places_far_off(const RoundInput&, const Round& round) {
  return round.verdict.distance ? round.verdict.distance->hot : std::vector<Vec3>{};
}

std::string say_distance(double distance, const char* limit_name, double limit) {
  return fmt::format(
      "the mesh departs from the surface by up to {:.3g}% of the diagonal, {} {:.3g}%",
      100 * distance, limit_name, 100 * limit);
}

std::string say_if_gated(const RoundInput& input, const Round& round) {
  if (!round.verdict.distance || !is_gated(input.options, max_distance(round))) return {};
  return say_beyond_gate(max_distance(round), input.options.sizing.tolerance);
}

std::string say_beyond_tolerance(const RoundInput& input, const Round& round) {
  if (!round.verdict.distance || is_within_tolerance(input, round) ||
      is_gated(input.options, max_distance(round)))
    return {};
  return say_distance(max_distance(round), "more than the tolerance of",
                      input.options.sizing.tolerance);
}

/// Tips of wedges are lost on any grid; with the right topology only their distance counts.
std::vector<Vec3> places_lost(const RoundInput& input, const Round& round) {
  if (input.target.expected.is_known && has_expected_topology(input, round)) return {};
  return round.fit.report.carve.lost;
}

/// Genus and components against the surface's are the judge's warnings already; a count that is
/// certainly wrong fails.
std::string say_components(const RoundInput& input, const Round& round) {
  const std::size_t num_components = round.verdict.topology.num_boundary_components;
  if (!input.target.expected.is_known || !is_inside(input) ||
      num_components == input.target.expected.num_components)
    return {};
  return fmt::format(
      "the mesh's boundary has {} components, the surface {}: parts or gaps thinner than the "
      "grid's cells were lost; use deeper levels",
      num_components, input.target.expected.num_components);
}

/// More of the volume than this is missing or too much: a failure, or a warning.
constexpr double kVolumeGate = 0.02, kVolumeGoal = 0.005;

bool is_volume_within_gate(const RoundInput& input, const Round& round) {
  return volume_off(input, round) <= kVolumeGate;
}

bool is_volume_near(const RoundInput& input, const Round& round) {
  return volume_off(input, round) <= kVolumeGoal;
}

std::string say_volume(const RoundInput& input, const Round& round, double limit) {
  return fmt::format("the mesh has {:.3g}% {} volume than the surface encloses, beyond {:.2g}%: {}",
                     100 * volume_off(input, round),
                     *round.verdict.volume_error > 0 ? "more" : "less", 100 * limit,
                     "parts are thin beside the tolerance; lower it");
}

std::string say_volume_beyond_gate(const RoundInput& input, const Round& round) {
  return is_volume_within_gate(input, round) ? std::string()
                                             : say_volume(input, round, kVolumeGate);
}

std::string say_volume_off(const RoundInput& input, const Round& round) {
  const bool is_said = is_volume_near(input, round) || !is_volume_within_gate(input, round);
  return is_said ? std::string() : say_volume(input, round, kVolumeGoal);
}

std::vector<Vec3> places_thin(const RoundInput&, const Round& round) { return round.thin_misses; }

std::vector<Vec3> places_thin_beyond_gate(const RoundInput& input, const Round& round) {
  return is_volume_within_gate(input, round) ? std::vector<Vec3>() : round.thin_misses;
}

bool is_volume_curable(const RoundInput&, const Round& round) { return !round.thin_misses.empty(); }

bool is_volume_gate_curable(const RoundInput& input, const Round& round) {
  return !is_volume_within_gate(input, round) && is_volume_curable(input, round);
}

bool has_least_quality(const RoundInput& input, const Round& round) {
  return round.verdict.quality.min_scaled_jacobian >= input.options.min_quality;
}

/// Inverted hexes are the judge's failure already; a second sentence about them would only blur it.
std::string say_quality(const RoundInput& input, const Round& round) {
  const QualitySummary& q = round.verdict.quality;
  if (q.num_inverted > 0 || has_least_quality(input, round)) return {};
  return fmt::format("the least scaled Jacobian is {:.3f}, below {:.2f}", q.min_scaled_jacobian,
                     input.options.min_quality);
}

double feature_share(const Round& round) {
  return round.verdict.features ? round.verdict.features->length_share : 1;
}

bool follows_features(const RoundInput& input, const Round& round) {
  return !misses_features(input, round);
}

double features_not_followed(const RoundInput&, const Round& round) {
  return 1 - feature_share(round);
}

std::vector<Vec3> places_on_features(const RoundInput&, const Round& round) {
  return round.refinable_features;
}

bool are_features_curable(const RoundInput&, const Round& round) {
  return !round.refinable_features.empty();
}

/// Curves without a path of mesh edges. How closely mapped ones are followed is the judge's figure.
std::string say_features(const RoundInput&, const Round& round) {
  const FitReport& f = round.fit.report;
  if (f.num_curves_mapped >= f.num_curves) return {};
  return fmt::format(
      "{} of {} feature curves ({:.1f}% of their length) are not represented by mesh edges",
      f.num_curves - f.num_curves_mapped, f.num_curves,
      f.curve_length > 0 ? 100 * (1 - f.curve_length_mapped / f.curve_length) : 0.0);
}

bool meets_mean(const RoundInput& input, const Round& round) {
  const double goal = mean_goal(input.options);
  return goal <= 0 || mean_distance(round) <= goal;
}

double mean_beyond_goal(const RoundInput& input, const Round& round) {
  return mean_distance(round) - mean_goal(input.options);
}

// A mesh beyond the gate is no result, however well shaped: distance to it goes before the rest.
// The mean has no places: scale_for_mean() makes all cells smaller.
constexpr Demand kDemands[] = {
    {.name = "valid",
     .is_met = is_valid,
     .places = places_of_contact,
     .severity = Severity::Failure},
    {.name = "within_gate",
     .is_met = is_near,
     .shortfall = distance_beyond_tolerance,
     .sentence = say_if_gated,
     .is_distance = true,
     .severity = Severity::Failure},
    {.name = "topology",
     .is_met = has_expected_topology,
     .places = places_lost,
     .sentence = say_components,
     .severity = Severity::Failure},
    {.name = "volume",
     .is_met = is_volume_within_gate,
     .shortfall = volume_off,
     .places = places_thin_beyond_gate,
     .is_curable = is_volume_gate_curable,
     .sentence = say_volume_beyond_gate,
     .severity = Severity::Failure},
    {.name = "within_tolerance",
     .is_met = is_within_tolerance,
     .shortfall = distance_beyond_tolerance,
     .places = places_far_off,
     .sentence = say_beyond_tolerance,
     .is_distance = true},
    {.name = "least_quality", .is_met = has_least_quality, .sentence = say_quality},
    {.name = "features",
     .is_met = follows_features,
     .shortfall = features_not_followed,
     .places = places_on_features,
     .is_curable = are_features_curable,
     .sentence = say_features},
    {.name = "mean", .is_met = meets_mean, .shortfall = mean_beyond_goal, .is_distance = true},
    {.name = "volume_near",
     .is_met = is_volume_near,
     .shortfall = volume_off,
     .places = places_thin,
     .is_curable = is_volume_curable,
     .sentence = say_volume_off,
     .is_minor = true},
};

/// The tolerance for distances is at most so many times the one for features (the default is five):
/// who asks for a coarse mesh does not pay for close curves.
constexpr double kMaxFeatureFactor = 5.001;

}  // namespace

std::span<const Demand> demands() { return kDemands; }

bool meets_no_less(const RoundInput& input, const Round& before, const Round& after) {
  return std::ranges::none_of(kDemands, [&](const Demand& demand) {
    const bool is_told = demand.sentence || demand.severity == Severity::Failure;
    return is_told && demand.is_met(input, before) && !demand.is_met(input, after);
  });
}

bool has_expected_topology(const RoundInput& input, const Round& round) {
  if (!input.target.expected.is_known || !is_inside(input)) return true;
  const TopologyReport& t = round.verdict.topology;
  return t.num_boundary_components == input.target.expected.num_components &&
         t.boundary_euler_characteristic == input.target.expected.euler_characteristic;
}

bool misses_features(const RoundInput& input, const Round& round) {
  const MeshOptions& options = input.options;
  return round.verdict.features && feature_share(round) < options.min_feature_share &&
         options.sizing.tolerance <= kMaxFeatureFactor * options.edge_tolerance;
}

/// Hidden walls would count in the surface's volume, and only sizing by deviation aims at the
/// shape.
double volume_off(const RoundInput& input, const Round& round) {
  const bool is_known = input.options.sizing.sizing == Sizing::Deviation && is_inside(input) &&
                        input.target.expected.is_all_boundary() && round.verdict.volume_error;
  return is_known ? std::abs(*round.verdict.volume_error) : 0;
}

bool is_gated(const MeshOptions& options, double distance) {
  return options.sizing.sizing == Sizing::Deviation && options.fit.carve.side == Side::Inside &&
         distance > kGateFactor * options.sizing.tolerance;
}

std::string say_beyond_gate(double distance, double tolerance) {
  return say_distance(distance, "more than the gate's", kGateFactor * tolerance);
}

double max_distance(const Round& round) {
  return round.verdict.distance ? round.verdict.distance->max_two_way() : 1;
}

double mean_distance(const Round& round) {
  return round.verdict.distance ? round.verdict.distance->mean_two_way() : 1;
}

}  // namespace hexwright
