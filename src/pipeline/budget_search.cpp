// A ladder of tolerances, the same for every budget.
#include "pipeline/budget_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "hexwright/base/error.h"

#include "base/words.h"
#include "pipeline/loop/round.h"

namespace hexwright {
namespace {

using Run = FunctionRef<MeshResult(const MeshOptions&, const Context&)>;

/// Cells shrink with the root of the tolerance, so that a step is about as many times the hexes.
constexpr double kStep = std::numbers::sqrt2;
constexpr double kCoarsest = 0.05;

/// Options from those asked for to the coarsest.
std::vector<MeshOptions> make_ladder(const MeshOptions& options) {
  std::vector<MeshOptions> ladder = {options};
  MeshOptions next = options;
  if (options.sizing.sizing != Sizing::Deviation) {
    while (next.sizing.max_level-- > options.sizing.min_level) ladder.push_back(next);
    return ladder;
  }
  while ((next.sizing.tolerance *= kStep) < kCoarsest) ladder.push_back(next);
  return ladder;
}

double distance_of(const MeshResult& result) {
  return result.verdict.distance ? result.verdict.distance->max_two_way() : 1;
}

/// Smaller is better. Within the tolerance all are alike.
auto rank(const MeshResult& result, double tolerance) {
  return std::make_tuple(!result.verdict.is_valid(), result.verdict.has_other_topology,
                         std::max(distance_of(result), tolerance));
}

/// Absent when it has, or would have, more hexes than allowed.
std::optional<MeshResult> try_rung(const MeshOptions& options, Run run, const Context& context) {
  std::vector<std::string> warnings;
  Context quiet = context;
  quiet.on_warning = [&warnings](std::string_view message) { warnings.emplace_back(message); };
  try {
    MeshResult result = run(options, quiet);
    if (result.mesh.num_hexes() > options.most_hexes) return {};
    result.warnings = std::move(warnings);
    return result;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::OutOfResources) throw;
    return {};
  }
}

bool is_near_enough(const MeshResult& result, double tolerance) {
  return result.failures.empty() && distance_of(result) <= tolerance;
}

/// The gate is that of the tolerance asked for.
void judge_as_asked(const MeshOptions& options, MeshResult& result) {
  const double gate = kGateFactor * options.sizing.tolerance, distance = distance_of(result);
  const bool is_said = distance > kGateFactor * result.tolerance;
  result.tolerance = options.sizing.tolerance;
  if (options.sizing.sizing != Sizing::Deviation || distance <= gate || is_said) return;
  result.failures.push_back(
      fmt::format("the mesh departs from the surface by up to {:.3g}% of the diagonal, more than "
                  "the gate's {:.3g}%",
                  100 * distance, 100 * gate));
}

}  // namespace

MeshResult search_budget(const MeshOptions& options, Run run, const Context& context) {
  const std::vector<MeshOptions> ladder = make_ladder(options);
  const double tolerance = options.sizing.tolerance;
  std::optional<MeshResult> best = try_rung(ladder.front(), run, context);
  if (best && !is_near_enough(*best, tolerance)) best.reset();  // in its turn
  for (std::size_t k = best ? 0 : ladder.size(); k-- > 0;) {
    std::optional<MeshResult> next = try_rung(ladder[k], run, context);
    if (!next) break;
    if (!best || rank(*next, tolerance) < rank(*best, tolerance)) best = std::move(*next);
  }
  if (!best)
    throw Error(ErrorCode::OutOfResources,
                fmt::format("the coarsest mesh has more hexes than the budget of {}; raise "
                            "--max-hexes{}",
                            options.most_hexes,
                            options.sizing.min_level > 0 ? " or lower --min-level" : ""));
  for (const std::string& warning : best->warnings) context.warn(warning);
  if (best->tolerance > tolerance || distance_of(*best) > tolerance)
    context.warn(fmt::format(
        "the budget of {} hexes ends refinement: the mesh has {} and departs by up to {:.3g}% of "
        "the diagonal, where {:.3g}% is asked for; raise --max-hexes or the tolerance",
        options.most_hexes, counted(best->mesh.num_hexes(), "hex", "hexes"),
        100 * distance_of(*best), 100 * tolerance));
  judge_as_asked(options, *best);
  return std::move(*best);
}

}  // namespace hexwright
