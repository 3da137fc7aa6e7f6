// Counts and lengths follow the size smoothly enough for a few steps to suffice.
#include "pipeline/size_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/pipeline/size_plan.h"

#include "mesh/tri_measures.h"

namespace hexwright {
namespace {

/// How much longer than asked 95% of the edges may be.
constexpr double kEdgeRoom = 1.05;
/// Aim a little lower: edges do not follow the lattice exactly.
constexpr double kEdgeMargin = 0.985;
constexpr double kLeastStep = 0.6;
/// Edges that are shorter than this share of what is allowed are worth another try.
constexpr double kEnough = 0.85;
constexpr int kMostEdgeRuns = 4;

MeshOptions with_size(const MeshOptions& options, double share) {
  MeshOptions sized = options;
  sized.sizes.size = {share, true};
  return sized;
}

/// The size as a share of the diagonal.
double share_of_size(const MeshOptions& options, const Target& target) {
  const Length& size = options.sizes.size;
  return size.is_share ? size.value : target.frame.length_to_unit(size.value) / target.diagonal();
}

/// Fewer failures first.
bool is_worse(const MeshResult& a, const MeshResult& b) {
  return a.failures.size() > b.failures.size();
}

/// The share of the size to try after edges were too long at `too_coarse`, and short enough, if
/// ever, at `fine`.
double next_scale(double too_coarse, std::optional<double> fine, double too_long_by) {
  if (fine) return std::sqrt(too_coarse * *fine);
  return too_coarse * std::max(kLeastStep, kEdgeMargin / too_long_by);
}

MeshResult shorten_edges(const Target& target, const MeshOptions& options, MeshRun run,
                         const Context& context) {
  const double share = share_of_size(options, target);
  const double longest = target.frame.length_to_world(kEdgeRoom * share * target.diagonal());
  MeshResult best = run_quietly(run, options, context);
  double too_coarse = 1, too_long_by = best.edges.high / longest;
  std::optional<double> fine;
  if (too_long_by <= 1) return say_warnings(std::move(best), context);
  for (int runs = 1; runs < kMostEdgeRuns; ++runs) {
    const double scale = next_scale(too_coarse, fine, too_long_by);
    std::optional<MeshResult> next = try_quietly(run, with_size(options, scale * share), context);
    if (!next) break;
    const double ratio = next->edges.high / longest;
    const bool is_usable = next->mesh.num_hexes() > 0 && !is_worse(*next, best);
    if (is_usable && (ratio <= 1 || !fine)) best = std::move(*next);
    if (ratio <= 1) fine = scale;
    if (ratio > 1) too_coarse = scale, too_long_by = ratio;
    // What a smaller size meets well may be met by one in between, with far fewer hexes.
    if (!is_usable || (fine && best.edges.high > kEnough * longest)) break;
  }
  if (best.edges.high > longest)
    context.warn(fmt::format("95% of the edges are up to {:.3g} times as long as --size asks for",
                             best.edges.high / longest * kEdgeRoom));
  return say_warnings(std::move(best), context);
}

/// Within this share of the number asked for.
constexpr double kCellRoom = 0.05;
constexpr int kMostCellRuns = 8;

/// Sizes and what they gave, from both sides of the number.
class CellSearch {
 public:
  explicit CellSearch(double wanted) : wanted_(wanted) {}

  void add(double size, double count) {
    auto& side = count < wanted_ ? below_ : above_;
    const std::pair<double, double> point = {std::log(size), std::log(count / wanted_)};
    if (!side || std::abs(point.second) < std::abs(side->second)) side = point;
    last_ = point;
  }

  /// By the line between the nearest counts on both sides; the cube of the size else.
  double next() const {
    if (!below_ || !above_) return std::exp(last_.first + last_.second / 3);
    const double t = below_->second / (below_->second - above_->second);
    return std::exp(below_->first + std::clamp(t, 0.1, 0.9) * (above_->first - below_->first));
  }

 private:
  double wanted_;
  std::optional<std::pair<double, double>> below_, above_;  ///< logarithms of size and ratio
  std::pair<double, double> last_;
};

MeshResult find_cells(const Target& target, const MeshOptions& options, MeshRun run,
                      const Context& context) {
  const auto wanted = static_cast<double>(options.sizes.cells);
  const double volume = std::abs(enclosed_volume(target.surface()));
  double share = std::cbrt(std::max(volume, 1e-9) / wanted) / target.diagonal();
  CellSearch search(wanted);
  std::optional<MeshResult> best;
  const auto off = [&](const MeshResult& r) {
    return std::abs(static_cast<double>(r.mesh.num_hexes()) / wanted - 1);
  };
  for (int runs = 0; runs < kMostCellRuns && (!best || off(*best) > kCellRoom); ++runs) {
    const MeshOptions sized = resolve_tolerance(with_size(options, share), target.diagonal());
    std::optional<MeshResult> result;
    if (best)
      result = try_quietly(run, sized, context);
    else
      result = run_quietly(run, sized, context);
    if (!result) break;
    search.add(share, std::max(1.0, static_cast<double>(result->mesh.num_hexes())));
    const bool is_better = !best || is_worse(*best, *result) ||
                           (!is_worse(*result, *best) && off(*result) < off(*best));
    if (is_better) best = std::move(*result);
    share = search.next();
  }
  if (off(*best) > kCellRoom)
    context.warn(fmt::format("the nearest to --cells {} is a mesh of {} hexes", options.sizes.cells,
                             best->mesh.num_hexes()));
  return say_warnings(std::move(*best), context);
}

}  // namespace

MeshResult search_sizes(const Target& target, const MeshOptions& options, MeshRun run,
                        const Context& context) {
  if (options.sizes.cells > 0) return find_cells(target, options, run, context);
  const bool is_inside = options.fit.carve.side == Side::Inside;
  if (options.sizes.size.is_given() && is_inside)
    return shorten_edges(target, options, run, context);
  return run(options, context);
}

}  // namespace hexwright
