// Says in words where the result falls short, and whether that fails the gate.
#include <fmt/format.h>

#include "pipeline/round.h"

namespace hexwright {
namespace {

/// Genus and components against the surface's are the judge's warnings already; a count that is
/// certainly wrong fails.
void judge_topology(const RoundInput& input, MeshResult& result) {
  if (!input.expected.is_known || input.options.fit.carve.side != Side::Inside) return;
  const TopologyReport& t = result.verdict.topology;
  if (t.num_boundary_components != input.expected.num_components)
    result.failures.push_back(fmt::format(
        "the mesh's boundary has {} components, the surface {}: parts or gaps thinner than the "
        "grid's cells were lost; use deeper levels",
        t.num_boundary_components, input.expected.num_components));
}

/// Up to the tolerance nothing, up to kGateFactor times the tolerance a warning, beyond it a
/// failure. Only meshes whose sizing aimed at a distance can miss one; around the object the outer
/// box is no part of the surface.
void judge_distance(const RoundInput& input, MeshResult& result) {
  if (!result.verdict.distance) return;
  const double distance = result.verdict.distance->max_two_way();
  const double tolerance = input.options.sizing.tolerance;
  if (distance <= tolerance) return;
  const bool is_gated = input.options.sizing.sizing == Sizing::Deviation &&
                        input.options.fit.carve.side == Side::Inside &&
                        distance > kGateFactor * tolerance;
  const std::string message =
      fmt::format("the mesh departs from the surface by up to {:.3g}% of the diagonal, {} {:.3g}%",
                  100 * distance, is_gated ? "more than the gate's" : "more than the tolerance of",
                  100 * (is_gated ? kGateFactor * tolerance : tolerance));
  if (is_gated)
    result.failures.push_back(message);
  else
    input.context.warn(message);
}

/// Inverted hexes are the judge's failure already; a second sentence about them would only blur it.
void judge_quality(const RoundInput& input, const MeshResult& result) {
  const QualitySummary& q = result.verdict.quality;
  if (q.num_inverted == 0 && q.min_scaled_jacobian < input.options.min_quality)
    input.context.warn(fmt::format("the least scaled Jacobian is {:.3f}, below {:.2f}",
                                   q.min_scaled_jacobian, input.options.min_quality));
}

/// Curves without a path of mesh edges. How closely mapped ones are followed is the judge's figure.
void judge_features(const RoundInput& input, const MeshResult& result) {
  const FitReport& f = result.fit;
  if (f.num_curves_mapped < f.num_curves)
    input.context.warn(fmt::format(
        "{} of {} feature curves ({:.1f}% of their length) are not represented by mesh edges",
        f.num_curves - f.num_curves_mapped, f.num_curves,
        f.curve_length > 0 ? 100 * (1 - f.curve_length_mapped / f.curve_length) : 0.0));
}

}  // namespace

void apply_gate(const RoundInput& input, MeshResult& result) {
  result.failures = result.verdict.failures;
  for (const std::string& w : result.verdict.warnings) input.context.warn(w);
  if (result.mesh.num_hexes() == 0) return;
  judge_topology(input, result);
  judge_distance(input, result);
  judge_quality(input, result);
  judge_features(input, result);
}

}  // namespace hexwright
