#include "relax/passes/sweep.h"

#include <atomic>
#include <cmath>
#include <limits>

#include "hexwright/base/parallel.h"

#include "relax/state/proof.h"
#include "relax/state/targets.h"

namespace hexwright::relax {
namespace {

VertexGoal make_goal(const Body& body, VertId v, const SweepOptions& options) {
  VertexGoal goal;
  const double h = body.size[v];
  if (!body.kind.empty()) {
    goal.attach = hold_of(body.kind[v]).attach;
    goal.weight = options.weight / (h * h);
    goal.target = body.target[v];
    goal.direction = body.direction[v];
  }
  goal.move = body.move[v];
  goal.axis = body.axis[v];
  goal.max_step = options.max_step * h;
  return goal;
}

// Vertices of one colour share neighbours, so two threads may set the same flag; all set it to 1.
void mark_dirty(Body& body, VertId v) {
  std::atomic_ref<char>(body.is_dirty[v]).store(1, std::memory_order_relaxed);
}

// Solves vertices one after the other; one object per thread.
class Solver {
 public:
  Solver(Body& body, const SweepOptions& options) : body_(body), options_(options) {}

  void solve(VertId v) {
    body_.is_dirty[v] = 0;
    const double h = body_.size[v];
    ShapeEnergy shape = options_.shape;
    if (options_.untangle_share > 0) shape.untangle = options_.untangle_share * (h * h * h);
    const Vec3 origin = body_.mesh.positions[v];
    const auto star = body_.stars[v];
    const double moved =
        newton_.solve(v, star, goal_of(v), shape, IdSpan<VertId, Vec3>(body_.mesh.positions));
    if (moved > 0 && ((options_.edge_floor > 0 && has_short_edge(v, origin)) ||
                      (options_.quality_floor > 0 && is_too_poor(v, origin)))) {
      body_.mesh.positions[v] = origin;
      return;
    }
    if (!(moved > options_.tolerance * h)) return;
    mark_dirty(body_, v);
    if (!options_.marks_neighbors) return;
    for (const HexStar& corner : star)
      for (VertId u : corner) mark_dirty(body_, u);
  }

 private:
  VertexGoal goal_of(VertId v) {
    VertexGoal goal = make_goal(body_, v, options_);
    goal.relaxation = options_.relaxation;
    if (options_.hex_weight) {
      weights_.clear();
      for (const HexCorner& corner : body_.vert_to_hex[v])
        weights_.push_back((*options_.hex_weight)[corner.hex]);
      goal.hex_weights = weights_;
    }
    return goal;
  }

  double shortest_edge_sq(VertId v, const Vec3& at) const {
    double least = std::numeric_limits<double>::infinity();
    for (const HexStar& star : body_.stars[v])
      for (std::size_t k = 0; k < 3; ++k)
        least = std::min(least, norm_sq(body_.mesh.positions[star[k]] - at));
    return least;
  }

  bool has_short_edge(VertId v, const Vec3& origin) const {
    const double floor = options_.edge_floor * body_.size[v];
    const double after = shortest_edge_sq(v, body_.mesh.positions[v]);
    return after < floor * floor && after < shortest_edge_sq(v, origin);
  }

  // Below the floor and poorer than at the origin, or without a proof that was there.
  bool is_too_poor(VertId v, const Vec3& origin) {
    const IdSpan<VertId, const Vec3> positions(body_.mesh.positions);
    const auto star = body_.stars[v];
    const Vec3 here = positions[v];
    const double after = min_scaled_jacobian_around(here, star, positions);
    if (after < options_.quality_floor &&
        after < min_scaled_jacobian_around(origin, star, positions))
      return true;
    if (after > kProvenQuality) return false;
    const int unproven = count_unproven_around(body_, v);
    if (unproven == 0) return false;
    body_.mesh.positions[v] = origin;
    const bool is_worse = unproven > count_unproven_around(body_, v);
    body_.mesh.positions[v] = here;
    return is_worse;
  }

  Body& body_;
  const SweepOptions& options_;
  VertexNewton newton_;
  std::vector<double> weights_;
};

constexpr std::size_t kVertsPerTask = 64;

// The vertices of a colour lie far apart in memory; asking ahead for what they need hides the wait.
#if defined(__GNUC__)
void prefetch(const void* p) { __builtin_prefetch(p); }
#else
void prefetch(const void*) {}
#endif

void prefetch_star(const Body& body, VertId v) {
  constexpr std::size_t kLine = 64;  // bytes
  const auto bytes = std::as_bytes(body.stars[v]);
  for (std::size_t i = 0; i < bytes.size(); i += kLine) prefetch(&bytes[i]);
}

void prefetch_positions(const Body& body, VertId v) {
  for (const HexStar& star : body.stars[v]) {
    prefetch(&body.mesh.positions[star[0]]);
    prefetch(&body.mesh.positions[star[3]]);
  }
}

}  // namespace

std::size_t sweep(Body& body, const SweepOptions& options) {
  std::vector<VertId> dirty;
  std::size_t count = 0;
  for (std::size_t c = 0; c < body.colors.num_colors(); ++c) {
    dirty.clear();
    for (VertId v : body.colors[c])
      if (body.is_dirty[v]) dirty.push_back(v);
    count += dirty.size();
    parallel_chunks(dirty.size(), kVertsPerTask, [&](std::size_t begin, std::size_t end) {
      Solver solver(body, options);
      for (std::size_t i = begin; i < end; ++i) {
        if (i + 2 < end) prefetch_star(body, dirty[i + 2]);
        if (i + 1 < end) prefetch_positions(body, dirty[i + 1]);
        solver.solve(dirty[i]);
      }
    });
  }
  return count;
}

LocalSweep::LocalSweep(const Body& body, const std::vector<char>& is_member) {
  offset_.push_back(0);
  for (std::size_t c = 0; c < body.colors.num_colors(); ++c) {
    for (VertId v : body.colors[c])
      if (is_member[v.index()]) verts_.push_back(v);
    offset_.push_back(verts_.size());
  }
}

void LocalSweep::run(Body& body, const SweepOptions& options) const { run(body, options, false); }
void LocalSweep::run_dirty(Body& body, const SweepOptions& options) const {
  run(body, options, true);
}

void LocalSweep::run(Body& body, const SweepOptions& options, bool only_dirty) const {
  for (std::size_t c = 0; c + 1 < offset_.size(); ++c) {
    const std::size_t first = offset_[c];
    parallel_chunks(offset_[c + 1] - first, kVertsPerTask, [&](std::size_t begin, std::size_t end) {
      Solver solver(body, options);
      for (std::size_t i = begin; i < end; ++i) {
        const VertId v = verts_[first + i];
        if (!only_dirty || body.is_dirty[v]) solver.solve(v);
      }
    });
  }
}

std::vector<double> geometric_weights(double first, double last, int count) {
  std::vector<double> weights;
  for (int k = 0; k < count; ++k)
    weights.push_back(first * std::pow(last / first, k / std::max(1.0, count - 1.0)));
  return weights;
}

void run_schedule(FitState& state, const FitTarget& target, const Schedule& schedule,
                  const Context& context) {
  const double release = 0.6 * static_cast<double>(schedule.weights.size());
  for (std::size_t k = 0; k < schedule.weights.size(); ++k) {
    context.check_cancelled();
    const double hold =
        schedule.hold_curves ? std::max(0.0, 1 - static_cast<double>(k) / release) : 0.0;
    update_targets(state, target, hold);
    SweepOptions options{schedule.shape, schedule.weights[k], schedule.tolerance};
    for (int s = 0; s < schedule.sweeps_per_weight; ++s) sweep(state, options);
  }
}

}  // namespace hexwright::relax
