// The negotiation: rounds of rerouting, moving corners, and dropping what stays in conflict.
#include "fit/curves/curve_router.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "fit/curves/ban_short_curves.h"
#include "fit/curves/curve_waypoints.h"

namespace hexwright::fitting {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHistoryStep = 1.5;
constexpr double kPressureGrowth = 1.5;
constexpr int kPressureRounds = 14;
constexpr double kGoldenShare = 0.381966;  // of a loop, between the starts of two routings
constexpr std::array<int, 3> kRelocationRounds = {14, 24, 34};

std::int64_t edge_key(VertId a, VertId b) {
  return (static_cast<std::int64_t>(std::min(a, b).value()) << 32) | std::max(a, b).value();
}

}  // namespace

CurveRouter::CurveRouter(const RoutingProblem& problem, std::vector<VertId> corner_verts)
    : in_(problem),
      corner_verts_(std::move(corner_verts)),
      routes_(problem.features.curves.size()),
      order_(problem.features.curves.size()),
      is_corner_(problem.graph.num_verts(), 0),
      occupancy_(problem.graph.num_verts(), 0),
      history_(problem.graph.num_verts(), 0.0),
      num_moves_(problem.graph.num_verts(), 0),
      tube_slot_(problem.graph.num_verts(), -1) {
  for (VertId v : corner_verts_)
    if (v.is_valid()) is_corner_[v.index()] = 1;
  for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = CurveId(i);
  std::stable_sort(order_.begin(), order_.end(), [&](CurveId x, CurveId y) {
    return in_.features.curves[x].length() < in_.features.curves[y].length();
  });
  for (CurveId c : order_) {
    if (!in_.options.is_banned.empty() && in_.options.is_banned[c])
      kill(c, "left out on request");
    else
      choose_ends(c);
  }
}

void CurveRouter::run() {
  for (int it = 0; it < in_.options.max_iterations; ++it) {
    num_iterations_ = it + 1;
    if (!negotiate_round(it)) break;
    const bool is_relocation = std::find(kRelocationRounds.begin(), kRelocationRounds.end(), it) !=
                               kRelocationRounds.end();
    if (is_relocation) relocate_congested_corners();
  }
  drop_conflicting();
  retry_dropped();
}

/// Reroutes the curves in conflict (all in the first round); true when conflicts remain.
bool CurveRouter::negotiate_round(int iteration) {
  pressure_ = 0.5;
  for (int k = 0; k < std::min(iteration, kPressureRounds); ++k) pressure_ *= kPressureGrowth;
  for (CurveId c : order_) {
    Route& r = routes_[c];
    if (!r.is_alive) continue;
    if (iteration > 0) {
      if (!has_conflict(c)) continue;
      clear_route(c);
      choose_ends(c);
    }
    if (r.is_alive) try_route(c);
  }
  return raise_history();
}

bool CurveRouter::raise_history() {
  bool any = false;
  for (VertId v : in_.graph.verts())
    if (is_contested(v)) {
      history_[v.index()] += kHistoryStep;
      any = true;
    }
  return any;
}

bool CurveRouter::has_conflict(CurveId c) const {
  const auto& path = routes_[c].path;
  return std::any_of(path.begin(), path.end(), [&](VertId v) { return is_contested(v); });
}

void CurveRouter::kill(CurveId c, std::string reason) {
  clear_route(c);
  routes_[c].is_alive = false;
  routes_[c].reason = std::move(reason);
}

void CurveRouter::clear_route(CurveId c) {
  if (!routes_[c].path.empty()) occupy(c, -1);
  routes_[c].path.clear();
}

/// Counts a path's vertices in (+1) or out (-1).
void CurveRouter::occupy(CurveId c, int change) {
  const auto& path = routes_[c].path;
  const std::size_t count = path.size() - (in_.features.curves[c].is_closed ? 1 : 0);
  for (std::size_t i = 0; i < count; ++i)
    if (!is_corner(path[i])) occupancy_[path[i].index()] += change;
  if (path.size() != 2) return;
  if (change > 0)
    direct_edges_[edge_key(path[0], path[1])] = c;
  else
    direct_edges_.erase(edge_key(path[0], path[1]));
}

bool CurveRouter::is_taken_edge(VertId a, VertId b, CurveId c) const {
  const auto it = direct_edges_.find(edge_key(a, b));
  return it != direct_edges_.end() && it->second != c;
}

// --- ends ---

/// The free vertex of the tube that suits a loop's start best: near the curve and not contested.
VertId CurveRouter::best_start(CurveId c, double arc) const {
  const Vec3 p = point_at_arc(in_.surface, in_.features.curves[c], arc).point;
  VertId best;
  double best_cost = kInfinity;
  for (const TubeVert& t : in_.tubes[c]) {
    if (is_corner(t.vert)) continue;
    if (!is_sharing_allowed_ && occupancy_[t.vert.index()] > 0) continue;
    const double d = distance(in_.boundary.positions[t.vert], p) / in_.boundary.edge_length[t.vert];
    const double congestion = pressure_ * occupancy_[t.vert.index()] + history_[t.vert.index()];
    const double cost = d + 0.2 * congestion;
    if (cost < best_cost) {
      best_cost = cost;
      best = t.vert;
    }
  }
  return best;
}

/// The corners of an open curve. A loop starts elsewhere each time, so that no vertex is forced on
/// it for long.
void CurveRouter::choose_ends(CurveId c) {
  const FeatureCurve& curve = in_.features.curves[c];
  Route& r = routes_[c];
  if (r.gates.empty())
    r.gates = find_waypoint_arcs(in_.surface, curve, mean_edge_length(in_.boundary, in_.tubes[c]));
  if (curve.is_closed) {
    const double turn = kGoldenShare * r.num_routings++;
    r.start_arc = curve.length() * (turn - std::floor(turn));
    r.source = r.target = best_start(c, r.start_arc);
    if (!r.source.is_valid()) kill(c, "no boundary vertex near it");
    return;
  }
  const auto [first, last] = in_.ends.curve_to_corners[c];
  r.source = corner_verts_[static_cast<std::size_t>(first)];
  r.target = corner_verts_[static_cast<std::size_t>(last)];
  if (!r.source.is_valid() || !r.target.is_valid()) kill(c, "no boundary vertex for its corner");
}

// --- corners that move ---

void CurveRouter::relocate_congested_corners() {
  std::vector<std::size_t> congested;
  for (CurveId c : order_) {
    const auto& path = routes_[c].path;
    if (in_.features.curves[c].is_closed) continue;
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (!is_contested(path[i])) continue;
      const auto [first, last] = in_.ends.curve_to_corners[c];
      if (i <= 2) congested.push_back(static_cast<std::size_t>(first));
      if (i + 3 >= path.size()) congested.push_back(static_cast<std::size_t>(last));
    }
  }
  std::sort(congested.begin(), congested.end());
  congested.erase(std::unique(congested.begin(), congested.end()), congested.end());
  for (std::size_t corner : congested) relocate_corner(corner);
}

VertId CurveRouter::best_relocation(std::size_t corner) const {
  const VertId old = corner_verts_[corner];
  std::vector<VertId> candidates;
  for (VertId v : in_.graph.neighbors(old)) {
    candidates.push_back(v);
    for (VertId w : in_.graph.neighbors(v)) candidates.push_back(w);
  }
  std::sort(candidates.begin(), candidates.end());
  VertId best;
  double best_cost = kInfinity;
  for (VertId v : candidates) {
    if (is_corner(v)) continue;
    const double cost =
        corner_cost(in_.boundary, in_.graph, v, in_.surface.positions[in_.features.corners[corner]],
                    in_.ends.degree[corner]) +
        0.3 * num_moves_[v.index()];
    if (cost < best_cost) {
      best_cost = cost;
      best = v;
    }
  }
  return best;
}

/// Moves a corner to another vertex of its 2-ring and reroutes the curves this touches.
void CurveRouter::relocate_corner(std::size_t corner) {
  const VertId old = corner_verts_[corner];
  const VertId now = best_relocation(corner);
  if (!now.is_valid()) return;
  ++num_moves_[old.index()];
  ++num_moves_[now.index()];
  std::vector<CurveId> affected;
  for (CurveId c : order_) {
    const Route& r = routes_[c];
    if (!r.is_alive) continue;
    const auto ends = in_.ends.curve_to_corners[c];
    const bool is_at_corner =
        ends[0] == static_cast<int>(corner) || ends[1] == static_cast<int>(corner);
    if (is_at_corner || std::find(r.path.begin(), r.path.end(), now) != r.path.end())
      affected.push_back(c);
  }
  for (CurveId c : affected) clear_route(c);
  is_corner_[old.index()] = 0;
  is_corner_[now.index()] = 1;
  corner_verts_[corner] = now;
  for (CurveId c : affected) choose_ends(c);
  for (CurveId c : affected)
    if (routes_[c].is_alive) try_route(c);
}

// --- the end ---

void CurveRouter::drop_conflicting() {
  while (true) {
    CurveId worst;
    std::ptrdiff_t worst_count = 0;
    for (CurveId c : order_) {
      const auto& path = routes_[c].path;
      const auto count =
          std::count_if(path.begin(), path.end(), [&](VertId v) { return is_contested(v); });
      if (count > worst_count) {
        worst_count = count;
        worst = c;
      }
    }
    if (!worst.is_valid()) return;
    kill(worst, "no way past other curves");
  }
}

/// Dropped curves may fit between those that stay.
void CurveRouter::retry_dropped() {
  is_sharing_allowed_ = false;
  for (CurveId c : order_) {
    Route& r = routes_[c];
    if (r.is_alive || !r.source.is_valid() || !r.target.is_valid()) continue;
    const std::string reason = r.reason;
    r.is_alive = true;
    choose_ends(c);
    if (r.is_alive && !try_route(c)) r.reason = reason;
  }
}

bool CurveRouter::try_route(CurveId c) {
  if (!route(c)) {
    kill(c, "no path near it");
    return false;
  }
  occupy(c, 1);
  return true;
}

}  // namespace hexwright::fitting
