// The stage's driver: a list of passes. See docs/algorithms/fit.md.
//
// Guarantee: the mesh starts valid (carving keeps valid hexes, padding is thinned until valid) and
// every later change of a position is accepted only when the corner determinants around it stay
// positive.
#include "hexwright/fit/fit.h"

#include <algorithm>
#include <atomic>

#include "hexwright/base/assert.h"
#include "hexwright/base/parallel.h"
#include "hexwright/quality/hex_quality.h"

#include "fit/finish.h"
#include "fit/pad_boundary.h"
#include "fit/pass_clock.h"
#include "fit/sweep.h"
#include "fit/targets.h"

namespace hexwright {
namespace {

using namespace fitting;

// The first hex with a corner determinant that is not positive.
HexId find_inverted(const HexMesh& mesh) {
  const auto quality = compute_scaled_jacobians(mesh);
  for (HexId h : quality.ids())
    if (!(quality[h] > 0)) return h;
  return {};
}

void require_valid(const HexMesh& background) {
  const HexId h = find_inverted(background);
  if (h.is_valid()) {
    throw Error(
        ErrorCode::BadArgument,
        "a corner of the hex is inverted or flat; repair the mesh first (improve untangles)",
        "hex " + std::to_string(h.value()));
  }
}

std::vector<Miss> find_misses(const FitState& state) {
  std::vector<Miss> misses;
  for (VertId v : state.kind.ids()) {
    if (!state.is_boundary(v) || state.stars[v].empty()) continue;
    const double residual = state.residual(v);
    if (residual > 0.02) misses.push_back({state.mesh.positions[v], residual * state.size[v]});
  }
  std::stable_sort(misses.begin(), misses.end(),
                   [](const Miss& a, const Miss& b) { return a.distance > b.distance; });
  return misses;
}

std::vector<HexId> find_unproven(const HexMesh& mesh) {
  std::vector<char> is_proven(mesh.num_hexes());
  parallel_for(
      mesh.num_hexes(),
      [&](std::size_t h) {
        is_proven[h] = check_positivity(mesh.corners(HexId(h))) == Positivity::Positive;
      },
      256);
  std::vector<HexId> unproven;
  for (std::size_t h = 0; h < is_proven.size(); ++h)
    if (!is_proven[h]) unproven.push_back(HexId(h));
  return unproven;
}

class Fitter {
 public:
  Fitter(const SurfaceTree& surface, const FitOptions& options, const Context& context)
      : surface_(surface), options_(options), context_(context), clock_(context, report_.seconds) {}

  FitResult run(const HexMesh& background) {
    clock_.run("check input", 0.0, [&] { require_valid(background); });
    HexMesh kept;
    clock_.run("carve", 0.02, [&] { kept = keep_hexes(background); });
    report_.num_hexes_carved = kept.num_hexes();
    if (kept.num_hexes() == 0) return {{}, std::move(report_)};
    FitState state(std::move(kept));
    clock_.run("pad", 0.2, [&] { pad_boundary(state); });
    clock_.run("fit1", 0.25, [&] { fit_smooth(state); });
    clock_.run("fit3", 0.5, [&] { fit_closely(state); });
    finish(state);
    report_.num_hexes_padded = state.mesh.num_hexes();
    report_.misses = find_misses(state);
    report_.unproven = find_unproven(state.mesh);
    HEXWRIGHT_ASSERT(!find_inverted(state.mesh).is_valid());
    remove_unused_verts(state.mesh);
    return {std::move(state.mesh), std::move(report_)};
  }

 private:
  HexMesh keep_hexes(const HexMesh& background) {
    if (!options_.do_carve) return background;
    report_.carve = carve(background, surface_, options_.carve, context_);
    return extract_hexes(background, report_.carve.is_kept);
  }

  FitTarget target() const { return {surface_, nullptr}; }

  // From the carve's staircase to the surface, without features.
  void fit_smooth(FitState& state) {
    run_schedule(state, target(), {{0, 1, 0}, geometric_weights(1, 300, 8), 2, 0.03, false},
                 context_);
  }

  // Onto the surface, and from the condition number's energy to the scaled Jacobian's.
  void fit_closely(FitState& state) {
    state.update_sizes();
    run_schedule(state, target(), {{0.9, 1, 0}, geometric_weights(300, 1e5, 4), 2, 0.015, false},
                 context_);
  }

  void finish(FitState& state) {
    clock_.run("refit", 0.7, [&] { refit_stuck(state, target(), {}, context_); });
    clock_.run("polish", 0.85, [&] { polish_worst(state, target(), {}, context_); });
    clock_.run("snap", 0.95, [&] { snap_to_targets(state, target(), options_.snap_quality); });
  }

  const SurfaceTree& surface_;
  const FitOptions& options_;
  const Context& context_;
  FitReport report_;
  PassClock clock_;
};

}  // namespace

FitResult fit(const HexMesh& background, const SurfaceTree& surface, const FitOptions& options,
              const Context& context) {
  return Fitter(surface, options, context).run(background);
}

}  // namespace hexwright
