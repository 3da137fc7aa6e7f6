// Says in words where the result falls short, and whether that fails the gate.
#include "pipeline/loop/demands.h"

namespace hexwright {

void apply_gate(const RoundInput& input, const Round& round, MeshResult& result) {
  result.failures = round.verdict.failures;
  for (const std::string& w : round.verdict.warnings) input.context.warn(w);
  if (round.fit.mesh.num_hexes() == 0) return;
  for (const Demand& demand : demands()) {
    if (!demand.sentence) continue;
    const std::string sentence = demand.sentence(input, round);
    if (sentence.empty()) continue;
    if (demand.severity == Severity::Failure)
      result.failures.push_back(sentence);
    else
      input.context.warn(sentence);
  }
}

}  // namespace hexwright
