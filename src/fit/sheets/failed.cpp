// Most squeezed quads are flat enough after the fit; hexes are spent only on the others.
#include "fit/sheets/failed.h"

#include <algorithm>

#include "relax/passes/pass.h"
#include "relax/state/targets.h"

namespace hexwright::fitting {

using namespace relax;
namespace {

std::vector<char> find_failed(const FitState& state, const FailedOptions& options) {
  std::vector<char> has_failed(state.num_verts(), 0);
  const IdSpan<VertId, const Vec3> positions(state.mesh.positions);
  for (VertId v : state.kind.ids()) {
    const bool is_feature = state.kind[v] == VertKind::Curve || state.kind[v] == VertKind::Corner;
    if (!is_feature || state.stars[v].empty()) continue;
    const double quality =
        min_scaled_jacobian_around(state.mesh.positions[v], state.stars[v], positions);
    has_failed[v.index()] = quality < options.low || state.residual(v) > options.stuck ? 1 : 0;
  }
  return has_failed;
}

std::size_t count(const std::vector<char>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), 1));
}

Pass approach_with(const ShapeEnergy& shape, const std::vector<double>& weights) {
  return {.sweep = {.shape = shape, .tolerance = 0.01},
          .weights = weights,
          .sweeps = 2,
          .again = Again::Dirty};
}

}  // namespace

SqueezedReport pad_failed_quads(FitState& state, BoundaryState& boundary, const FitTarget& target,
                                const FailedOptions& options, const Context& context) {
  update_targets(state, target, 0);
  SqueezedOptions squeezed;
  squeezed.whole_regions = false;
  squeezed.is_wanted = find_failed(state, options);
  const std::size_t num_failed = count(squeezed.is_wanted);
  if (num_failed == 0) return {};
  FitState tried = state;
  BoundaryState tried_boundary = boundary;
  const SqueezedReport report = pad_squeezed_quads(tried, tried_boundary, squeezed);
  if (report.num_sheets == 0) return report;
  std::vector<char> region(tried.num_verts(), 0);
  for (std::size_t v = state.num_verts(); v < region.size(); ++v) region[v] = 1;
  grow_vert_set(tried, region, options.rings);
  const auto light = geometric_weights(3, 300, 5), heavy = geometric_weights(300, 1e5, 5);
  run_on(region, approach_with({0, 1, 0}, light), tried, target, context);
  run_on(region, approach_with({0.9, 1, 0}, heavy), tried, target, context);
  relax::run(kRefit, tried, target, context);
  update_targets(tried, target, 0);
  const auto most = options.worthwhile * static_cast<double>(num_failed);
  if (static_cast<double>(count(find_failed(tried, options))) > most) return {};
  state = std::move(tried);
  boundary = std::move(tried_boundary);
  return report;
}

}  // namespace hexwright::fitting
