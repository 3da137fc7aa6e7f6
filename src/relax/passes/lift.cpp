// The worst elements after everything has arrived: boundary vertices slide in the tangent plane of
// the surface or along the tangent of their curve, so that quality is not bought with distance.
#include <algorithm>

#include "hexwright/base/context.h"
#include "hexwright/base/parallel.h"
#include "hexwright/quality/hex_quality.h"

#include "relax/passes/finish.h"
#include "relax/passes/slide_only.h"
#include "relax/passes/sweep.h"
#include "relax/state/targets.h"

namespace hexwright::relax {
namespace {

struct Score {
  double least = 0;           // scaled Jacobian
  double residual = 0;        // sum of squares, in h
  double worst_residual = 0;  // in h

  // More quality, and not paid for with distance.
  bool beats(const Score& other, double slack) const {
    return least > other.least + 1e-4 && residual <= other.residual + slack &&
           worst_residual <= other.worst_residual + 0.01;
  }
};

class Lifter {
 public:
  Lifter(FitState& state, const FitTarget& target, const LiftOptions& options)
      : state_(state), target_(target), options_(options) {
    update_targets(state, target, 0);
    quality_ = compute_scaled_jacobians(state.mesh);
    residual_.assign(state.num_verts(), 0);
    for (VertId v : residual_.ids()) measure_residual(v);
    remember(score());
  }

  void run(const Context& context) {
    int power = 3;
    for (int round = 0; round < options_.max_rounds && best_.least < options_.goal; ++round) {
      context.check_cancelled();
      work_on_worst(power);
      const Score now = score();
      if (now.beats(best_, options_.residual_slack)) {
        const bool is_progress = now.least > best_.least + 1e-3;
        remember(now);
        if (is_progress) continue;
      }
      if (power >= 48) break;
      power *= 2;
    }
    state_.mesh.positions = best_positions_;
    state_.arc = best_arcs_;
    update_targets(state_, target_, 0);
  }

 private:
  void work_on_worst(int power) {
    const double least = *std::min_element(quality_.begin(), quality_.end());
    const auto region = surroundings(std::min(options_.goal, least + 0.1 * (1 - least)));
    update_targets(state_, target_, 0, region);
    {
      const SlideOnly slide(state_, region);
      const LocalSweep local(state_, region);
      SweepOptions options{{1, power, 0}, 0, 0.03};
      options.edge_floor = kEdgeFloor;
      for (int s = 0; s < 4; ++s) local.run(state_, options);
    }
    snap_to_targets(state_, target_, least, region);
    measure(region);
  }

  std::vector<char> surroundings(double low) const {
    std::vector<char> region = verts_of_hexes(state_, [&](HexId h) { return quality_[h] <= low; });
    grow_vert_set(state_, region, 1);
    return region;
  }

  void measure_residual(VertId v) {
    residual_[v] = state_.stars[v].empty() ? 0 : state_.residual(v);
  }

  // What changed when the vertices of a region moved: rounds cost what they touch.
  void measure(const std::vector<char>& region) {
    const auto is_in_region = [&](VertId v) { return region[v.index()] != 0; };
    parallel_for(
        quality_.size(),
        [&](std::size_t i) {
          const auto& hex = state_.mesh.hexes[HexId(i)];
          if (std::any_of(hex.begin(), hex.end(), is_in_region))
            quality_[HexId(i)] = scaled_jacobian(state_.mesh.corners(HexId(i)));
        },
        2048);
    for (VertId v : residual_.ids())
      if (is_in_region(v)) measure_residual(v);
  }

  Score score() const {
    Score s;
    s.least = *std::min_element(quality_.begin(), quality_.end());
    for (double r : residual_) {
      s.residual += r * r;
      s.worst_residual = std::max(s.worst_residual, r);
    }
    return s;
  }

  void remember(const Score& score) {
    best_ = score;
    best_positions_ = state_.mesh.positions;
    best_arcs_ = state_.arc;
  }

  FitState& state_;
  const FitTarget& target_;
  const LiftOptions& options_;
  IdVector<HexId, double> quality_;
  IdVector<VertId, double> residual_;  // in h
  Score best_;
  IdVector<VertId, Vec3> best_positions_;
  IdVector<VertId, double> best_arcs_;  // targets on curves are looked for near these
};

}  // namespace

void lift_worst(FitState& state, const FitTarget& target, const LiftOptions& options,
                const Context& context) {
  Lifter(state, target, options).run(context);
}

}  // namespace hexwright::relax
