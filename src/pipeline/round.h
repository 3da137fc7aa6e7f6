// One round of the loop: a sizing grid through completion, dual, fit and judgement.
#pragma once

#include <optional>

#include "hexwright/geometry/expected_topology.h"
#include "hexwright/pipeline/mesh_surface.h"

#include "pipeline/crowded_features.h"

namespace hexwright {

/// The gate of distance, as a multiple of the tolerance; see mesh_surface.h.
constexpr double kGateFactor = 2;

/// On a defective surface, from a valid mesh within the gate, a round must not cost more than this
/// factor in cells: misses that dense marks do not cure (along the seams of parts that overlap)
/// would multiply the mesh. On a sound one the next round may well need many times the cells of a
/// coarse mesh that came within the gate by luck.
constexpr double kMaxGrowth = 2.5;

/// What all rounds share.
struct RoundInput {
  const SurfaceTree& tree;
  const MeshOptions& options;
  const ExpectedTopology& expected;
  const Context& context;
  /// The curves of the verdicts; without them none is taken to be crowded.
  const FeatureGraph* features = nullptr;
};

struct Round {
  Grid grid;  ///< completed
  CompleteReport complete;
  DualReport dual;
  FitResult fit;
  Verdict verdict;
  /// Places on the features that finer cells can help to follow; none when enough is followed.
  std::vector<Vec3> refinable_features;
  /// Those among them where curves crowd, with the cells that tell them apart.
  std::vector<SizedPlace> crowded_features;
  std::vector<StageRecord> stages;
  RoundRecord record;
};

/// Runs the stages on an already completed grid.
Round run_round(const RoundInput& input, CompleteResult completed);

/// The mean two-way distance the loop is content with, a share of the diagonal; 0 = any.
inline double mean_goal(const MeshOptions& options) {
  return options.mean_share * options.sizing.tolerance;
}

/// Whether nothing is left to refine for.
bool is_content(const RoundInput& input, const Round& round);

/// Whether the mesh is valid and no farther off than the gate allows.
bool is_within_gate(const RoundInput& input, const Round& round);

/// Whether a next grid of so many cells would break kMaxGrowth.
bool is_out_of_proportion(const RoundInput& input, const Round& round, std::size_t num_next_cells);

/// Whether `a` is the better result: valid before invalid, within the gate before beyond, right
/// topology before wrong, within the tolerance before beyond, then quality, then features that are
/// followed closely, then the mean distance within its share. Among equals the nearer one; when
/// both are near enough, the one that follows more of its features; when both follow enough, the
/// one nearer in the mean, and when both are near enough in that, the smaller one.
bool is_better(const RoundInput& input, const Round& a, const Round& b);

/// How much smaller all cells must become for the mean distance to reach its goal, when nothing
/// else is missed that this would not mend.
std::optional<double> scale_for_mean(const RoundInput& input, const Round& round);

/// The loop's leaves are no deeper than this.
int deepest_level(const MeshOptions& options);

/// Leaves of the completed grid that hold points the fit missed, of the surface or of its features,
/// and where the mesh's boundary touches itself; when there are none but the topology is not the
/// surface's, those of thin parts and gaps.
std::vector<char> mark_misses(const RoundInput& input, const Round& round);

/// Fills `failures` and `warnings` of the result by the gate.
void apply_gate(const RoundInput& input, MeshResult& result);

}  // namespace hexwright
