// Three stages, each on the vertices of hexes that need it and with a few sweeps at a time:
//   untangle  regularised energy around inverted hexes;
//   improve   barrier energies of growing power, so that the worst corners dominate at the end;
//   raise     weighted energies that raise the mean scaled Jacobian and hold up the least.
// Based on: Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov, "Foldover-free maps in 50 lines
// of code", ACM TOG 40(4), 2021 (regularised determinants, decreased until nothing is inverted);
// Hunter, Lange, "A tutorial on MM algorithms", The American Statistician 58(1), 2004 (the
// weights). Differs: solved vertex by vertex with Newton steps, and only around bad hexes.
#include "dual/optimize.h"

#include <algorithm>
#include <span>
#include <vector>

#include "hexwright/base/parallel.h"
#include "hexwright/mesh/hex_shape.h"

#include "dual/quality_of_hex.h"
#include "relax/kernel/vertex_newton.h"

namespace hexwright::dual {

using namespace relax;

namespace {

// One way of improving what is bad: hexes whose scaled Jacobian is below `goal`.
struct Pass {
  double goal;
  int num_rounds;  // each: collect the bad hexes, then a few sweeps over their vertices
  int num_rings;   // layers of hexes around them that move along
  ShapeEnergy shape;
};

// First almost everywhere, as a start for what follows; then where something is really bad.
constexpr Pass kImprovePasses[] = {{0.9, 1, 1, {0.8, 1, 0}}, {0.4, 4, 2, {0.9, 4, 0}}};

class PositionOptimizer {
 public:
  PositionOptimizer(HexMesh& mesh, const VertToHex& vert_to_hex, const FixedAxes& fixed_axes)
      : mesh_(mesh),
        stars_(mesh, vert_to_hex),
        colors_(mesh, vert_to_hex),
        vert_to_hex_(vert_to_hex),
        fixed_axes_(fixed_axes),
        max_step_(mesh.num_verts()),
        quality_(mesh.num_hexes()),
        has_moved_(mesh.num_verts(), 0) {
    parallel_for(mesh.num_verts(),
                 [&](std::size_t v) { max_step_[VertId(v)] = 0.5 * mean_edge(VertId(v)); });
    measure();
  }

  // Repeats regularised sweeps around hexes that are inverted or nearly so, with less and less
  // regularisation and wider and wider surroundings. False when some are left.
  bool untangle(const Context& context) {
    constexpr double kClearlyPositive = 0.02;
    constexpr int kMaxRounds = 40;
    double untangle = 0.3;  // in units of the local edge cubed
    for (int round = 0; round < kMaxRounds; ++round) {
      context.check_cancelled();
      if (!activate(kClearlyPositive, 2 + round / 6)) return true;
      sweep_repeatedly({0, 1, untangle});
      measure();
      untangle = std::max(0.7 * untangle, 0.01);
    }
    return !activate(kPositive, 1);
  }

  // Lets the boundary vertices of inverted hexes leave the boundary: some corners where the domain
  // is neither convex nor concave leave no other way. Returns how many.
  std::size_t free_inverted() {
    std::size_t num_freed = 0;
    for (HexId h : mesh_.hexes.ids()) {
      if (quality_[h] >= kPositive) continue;
      for (VertId v : mesh_.hexes[h]) {
        num_freed += fixed_axes_[v] != 0;
        fixed_axes_[v] = 0;
      }
    }
    return num_freed;
  }

  void improve(const Pass& pass, const Context& context) {
    for (int round = 0; round < pass.num_rounds; ++round) {
      context.check_cancelled();
      if (!activate(pass.goal, pass.num_rings)) return;
      sweep_repeatedly(pass.shape);
      measure();
    }
  }

  // Raises the sum over hexes of a soft minimum of their scaled Jacobians: s = T^(-1/p), with T the
  // sum of s_c^(-p) over the hex's corners. -s is concave in T, so its tangent lies above it: a
  // step that lowers the sum of T weighted by the tangents' slopes (s^(p+1), up to a constant)
  // raises the sum of s. Poor hexes keep the weight of a hex at kKnee: from there down the plain
  // sum of T is what falls, which holds up the least.
  void raise_mean(const Context& context) {
    constexpr int kRounds = 2, kSweeps = 4;
    constexpr double kGoal = 0.95;
    weight_.resize(mesh_.num_hexes());
    for (int round = 0; round < kRounds; ++round) {
      context.check_cancelled();
      if (!activate(kGoal, 1)) break;
      for (int k = 0; k < kSweeps; ++k) {
        parallel_for(mesh_.num_hexes(),
                     [&](std::size_t h) { weight_[HexId(h)] = mean_weight(HexId(h)); });
        sweep({1, kMeanPower / 2, 0});
      }
      measure();
    }
    weight_.clear();
  }

 private:
  static constexpr int kSweepsPerRound = 3;
  static constexpr double kPositive = 1e-3;  // below: inverted, or flat but for rounding
  static constexpr int kMeanPower = 8;       // p: the larger, the closer to the least corner

  double mean_weight(HexId h) const {
    constexpr double kKnee = 0.6;
    const double s = std::max(kKnee, soft_scaled_jacobian(mesh_, h));
    const double s2 = s * s, s4 = s2 * s2;
    return s4 * s4 * s;  // s^(p+1)
  }

  VertexGoal goal_of(VertId v) const {
    VertexGoal goal;
    goal.max_step = max_step_[v];
    const int fixed_axes = fixed_axes_[v];
    if (fixed_axes == 7) goal.move = MoveIn::Point;
    for (int a = 0; a < 3; ++a) {
      const bool is_plane = fixed_axes == 1 << a, is_line = fixed_axes == (7 ^ 1 << a);
      if (!is_plane && !is_line) continue;
      goal.move = is_plane ? MoveIn::Plane : MoveIn::Line;
      goal.axis[a] = 1;
    }
    return goal;
  }

  double mean_edge(VertId v) const {
    double sum = 0;
    for (const HexStar& star : stars_[v])
      for (int k = 0; k < 3; ++k) sum += distance(mesh_.positions[v], mesh_.positions[star[k]]);
    return sum / std::max(1.0, 3.0 * static_cast<double>(stars_[v].size()));
  }

  void measure() {
    parallel_for(mesh_.num_hexes(), [&](std::size_t h) {
      quality_[HexId(h)] = scaled_jacobian(mesh_.corners(HexId(h)));
    });
  }

  // Collects, by colour, the vertices of the hexes below `goal` and of `num_rings - 1` layers of
  // hexes around them. False when there is no such hex.
  bool activate(double goal, int num_rings) {
    std::vector<char> is_active(mesh_.num_verts(), 0);
    bool has_bad = false;
    for (HexId h : mesh_.hexes.ids()) {
      if (quality_[h] >= goal) continue;
      has_bad = true;
      for (VertId v : mesh_.hexes[h]) is_active[v.index()] = 1;
    }
    if (!has_bad) return false;
    for (int ring = 1; ring < num_rings; ++ring) grow(is_active);
    active_.assign(colors_.num_colors(), {});
    for (std::size_t c = 0; c < colors_.num_colors(); ++c)
      for (VertId v : colors_[c])
        if (is_active[v.index()]) active_[c].push_back(v);
    return true;
  }

  void grow(std::vector<char>& is_active) const {
    const auto before = is_active;
    for (const auto& hex : mesh_.hexes) {
      bool touches = false;
      for (VertId v : hex) touches |= before[v.index()] != 0;
      if (!touches) continue;
      for (VertId v : hex) is_active[v.index()] = 1;
    }
  }

  void sweep_repeatedly(const ShapeEnergy& shape) {
    for (int k = 0; k < kSweepsPerRound; ++k) sweep(shape);
  }

  // Solves the active vertices once; those that hardly moved are no longer active.
  void sweep(const ShapeEnergy& shape) {
    for (auto& verts : active_) {
      parallel_chunks(verts.size(), 256, [&](std::size_t begin, std::size_t end) {
        solve_verts(std::span(verts).subspan(begin, end - begin), shape);
      });
      std::erase_if(verts, [&](VertId v) { return !has_moved_[v.index()]; });
    }
  }

  // Vertices of one colour: none reads what another one writes.
  void solve_verts(std::span<const VertId> verts, const ShapeEnergy& shape) {
    constexpr double kStill = 0.02;  // share of the longest step
    const IdSpan<VertId, Vec3> positions(mesh_.positions);
    VertexNewton newton;
    std::vector<double> weights;
    for (VertId v : verts) {
      const double edge = 2 * max_step_[v];
      ShapeEnergy scaled = shape;
      scaled.untangle *= edge * edge * edge;
      VertexGoal goal = goal_of(v);
      if (!weight_.empty()) {
        weights.clear();
        for (const HexCorner& corner : vert_to_hex_[v]) weights.push_back(weight_[corner.hex]);
        goal.hex_weights = weights;
      }
      const double moved = newton.solve(v, stars_[v], goal, scaled, positions);
      has_moved_[v.index()] = moved > kStill * max_step_[v];
    }
  }

  HexMesh& mesh_;
  VertexStars stars_;
  VertexColors colors_;
  const VertToHex& vert_to_hex_;
  FixedAxes fixed_axes_;
  IdVector<VertId, double> max_step_;
  IdVector<HexId, double> quality_;
  IdVector<HexId, double> weight_;           // of each hex's energy; empty: all one
  std::vector<std::vector<VertId>> active_;  // per colour
  std::vector<char> has_moved_;              // per vertex, in its last solve
};

}  // namespace

std::size_t optimize_positions(HexMesh& mesh, const VertToHex& vert_to_hex,
                               const FixedAxes& fixed_axes, const Context& context) {
  constexpr int kMaxReleases = 3;
  PositionOptimizer optimizer(mesh, vert_to_hex, fixed_axes);
  std::size_t num_freed = 0;
  bool is_clear = optimizer.untangle(context);
  for (int k = 0; k < kMaxReleases && !is_clear; ++k) {
    num_freed += optimizer.free_inverted();
    is_clear = optimizer.untangle(context);
  }
  for (const Pass& pass : kImprovePasses) optimizer.improve(pass, context);
  optimizer.raise_mean(context);
  return num_freed;
}

}  // namespace hexwright::dual
