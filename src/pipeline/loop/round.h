// One round of the loop: a sizing grid through completion, dual, fit and judgement.
#pragma once

#include <optional>

#include "hexwright/pipeline/plan.h"

#include "pipeline/loop/crowded_features.h"

namespace hexwright {

/// The gate of distance, as a multiple of the tolerance; see mesh_surface.h.
constexpr double kGateFactor = 2;

/// What all rounds share.
struct RoundInput {
  const Target& target;
  const MeshOptions& options;
  const StagePlan& plan;
  const Context& context;
};

struct Round {
  Grid grid;  ///< completed
  CompleteReport complete;
  DualReport dual;
  FitResult fit;
  std::optional<CurvingReport> curving;  ///< of second order, as which the mesh is judged then
  Verdict verdict;
  /// Places on the features that finer cells can help to follow; none when enough is followed.
  std::vector<Vec3> refinable_features;
  /// Those among them where curves crowd, with the cells that tell them apart.
  std::vector<SizedPlace> crowded_features;
  /// Places at walls that are too thin or too thick, when the volume is off.
  std::vector<Vec3> thin_misses;
  std::vector<StageRecord> stages;
  RoundRecord record;
};

/// Gives the round's mesh its mid-nodes, on the exact shape where there is one, when second order
/// is asked for.
void curve_round(const RoundInput& input, Round& round, const ExactShape* exact = nullptr);

/// Notes distances and quality of the round's mesh as it is now.
void record_shape(const Round& round, RoundRecord& record);

/// Runs the stages on an already completed grid, without the lift.
Round run_round(const RoundInput& input, CompleteResult completed);

/// Lets the boundary of a round's mesh leave the surface within the tolerance where that raises its
/// least scaled Jacobian; the round as it was when that misses a demand that is met now and that
/// users are told of.
Round lift_round(const RoundInput& input, Round round);

/// Puts the wall layers that are asked for into the round's mesh, and judges it with them. Fills
/// the result's `layers` and `layer`.
Round layer_round(const RoundInput& input, Round round, MeshResult& result);

/// The mean two-way distance the loop is content with, a share of the diagonal; 0 = any.
inline double mean_goal(const MeshOptions& options) {
  return options.mean_share * options.sizing.tolerance;
}

/// Whether the mesh is valid and no farther off than the gate allows.
bool is_within_gate(const RoundInput& input, const Round& round);

/// The loop's leaves are no deeper than this.
int deepest_level(const MeshOptions& options);

/// Fills the result's `failures` and warns by the gate, demand by demand.
void apply_gate(const RoundInput& input, const Round& round, MeshResult& result);

}  // namespace hexwright
