// Says in words where the result falls short, and whether that fails the gate.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipeline/loop/demands.h"

namespace hexwright {
namespace {

/// What was asked of wall layers.
void judge_layers(const LayersOptions& options, const LayersReport& report,
                  std::vector<std::string>& failures) {
  for (const std::string& pattern : report.unmatched)
    failures.push_back(
        fmt::format("no patch has a name like '{}', which layers are asked for; the "
                    "patches are {}",
                    pattern, fmt::join(report.names, ", ")));
  if (report.coverage() < options.min_coverage)
    failures.push_back(fmt::format(
        "{:.1f}% of the walls' area has all layers, less than the {:.1f}% asked for; ask for lower "
        "layers, or for smaller cells",
        100 * report.coverage(), 100 * options.min_coverage));
}

}  // namespace

void apply_gate(const RoundInput& input, const Round& round, MeshResult& result) {
  result.failures = round.verdict.failures;
  for (const std::string& w : round.verdict.warnings) input.context.warn(w);
  if (round.fit.mesh.num_hexes() == 0) return;
  judge_layers(input.options.layers, result.layers, result.failures);
  for (const PatchLayers& row : result.layers.patches)
    if (!row.note.empty()) input.context.warn(row.patch + " has no layers in places: " + row.note);
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
