// One round of the loop: a sizing grid through completion, dual, fit and judgement.
#pragma once

#include <optional>

#include "hexwright/pipeline/mesh_surface.h"

#include "pipeline/expected_topology.h"

namespace hexwright {

/// What all rounds share.
struct RoundInput {
  const SurfaceTree& tree;
  const MeshOptions& options;
  const ExpectedTopology& expected;
  const Context& context;
};

struct Round {
  Grid grid;  ///< completed
  CompleteReport complete;
  DualReport dual;
  FitResult fit;
  Verdict verdict;
  std::vector<StageRecord> stages;
  RoundRecord record;
};

/// Runs the stages on an already completed grid.
Round run_round(const RoundInput& input, CompleteResult completed);

/// Whether nothing is left to refine for.
bool is_content(const RoundInput& input, const Round& round);

/// Whether `a` is the better result: valid before invalid, right topology before wrong, within the
/// tolerance before beyond, then quality; among equals the nearer one, or the smaller one when
/// both are within.
bool is_better(const RoundInput& input, const Round& a, const Round& b);

/// Leaves of the completed grid that hold points the fit missed.
std::vector<char> mark_misses(const RoundInput& input, const Round& round);

/// Fills `failures` and `warnings` of the result by the gate.
void apply_gate(const RoundInput& input, MeshResult& result);

}  // namespace hexwright
