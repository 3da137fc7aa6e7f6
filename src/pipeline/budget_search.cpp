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
#include "pipeline/loop/demands.h"

namespace hexwright {
namespace {

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

bool is_near_enough(const MeshResult& result, double tolerance) {
  return result.failures.empty() && distance_of(result) <= tolerance;
}

/// The gate is that of the tolerance asked for, not of the one that led to the mesh.
void judge_as_asked(const MeshOptions& options, MeshResult& result) {
  const double distance = distance_of(result);
  std::erase(result.failures, say_beyond_gate(distance, result.options.sizing.tolerance));
  result.options.sizing.tolerance = options.sizing.tolerance;
  if (is_gated(options, distance))
    result.failures.push_back(say_beyond_gate(distance, result.options.sizing.tolerance));
}

}  // namespace

MeshResult search_budget(const MeshOptions& options, MeshRun run, const Context& context) {
  const std::vector<MeshOptions> ladder = make_ladder(options);
  const double tolerance = options.sizing.tolerance;
  std::optional<MeshResult> best, first = try_quietly(run, ladder.front(), context);
  if (first && (!first->is_limited || is_near_enough(*first, tolerance)))
    return say_warnings(std::move(*first), context);
  const auto is_nearer = [&](const MeshResult& next) {
    return !best || rank(next, tolerance) < rank(*best, tolerance);
  };
  bool fits = true;
  for (std::size_t k = ladder.size(); fits && --k > 0;) {
    std::optional<MeshResult> next = try_quietly(run, ladder[k], context);
    fits = next.has_value();
    if (fits && is_nearer(*next)) best = std::move(*next);
  }
  if (fits && first && is_nearer(*first)) best = std::move(*first);
  if (!best)
    throw Error(
        ErrorCode::OutOfResources,
        fmt::format("the coarsest mesh has more hexes than the budget of {}; raise "
                    "--max-hexes{}{}",
                    options.most_hexes, options.sizes.any() ? " or ask for larger cells" : "",
                    options.sizing.min_level > 0 ? " or lower --min-level" : ""));
  MeshResult result = say_warnings(std::move(*best), context);
  if (result.options.sizing.tolerance > tolerance || distance_of(result) > tolerance)
    context.warn(fmt::format(
        "the budget of {} hexes ends refinement: the mesh has {} and departs by up to {:.3g}% of "
        "the diagonal, where {:.3g}% is asked for; raise --max-hexes or the tolerance",
        options.most_hexes, counted(result.mesh.num_hexes(), "hex", "hexes"),
        100 * distance_of(result), 100 * tolerance));
  judge_as_asked(options, result);
  return result;
}

}  // namespace hexwright
