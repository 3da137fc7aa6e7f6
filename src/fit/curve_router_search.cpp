// The shortest path searches of the curve router: Dijkstra from waypoint to waypoint in the tube.
#include <algorithm>
#include <limits>
#include <queue>

#include "fit/curve_router.h"

namespace hexwright::fitting {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kWindowSlack = 3;    // edge lengths beyond a segment's arcs
constexpr double kMaxDistanceSq = 4;  // a vertex farther than two edge lengths costs no more

struct QueueItem {
  double cost;
  VertId vert;
  friend bool operator>(const QueueItem& x, const QueueItem& y) {
    return x.cost != y.cost ? x.cost > y.cost : x.vert > y.vert;
  }
};

}  // namespace

struct CurveRouter::Search {
  CurveId curve;
  VertId source, target;
  double arc_lo, arc_hi;  // of the waypoints; vertices nearest to other parts of the curve are out
};

void CurveRouter::load_tube(CurveId c) {
  if (loaded_ == c) return;
  if (loaded_.is_valid())
    for (const TubeVert& t : in_.tubes[loaded_]) tube_slot_[t.vert.index()] = -1;
  const auto& tube = in_.tubes[c];
  for (std::size_t i = 0; i < tube.size(); ++i)
    tube_slot_[tube[i].vert.index()] = static_cast<int>(i);
  loaded_ = c;
}

/// Fills the curve's path; false (and no path) when a segment finds no way.
bool CurveRouter::route(CurveId c) {
  load_tube(c);
  const auto& waypoints = routes_[c].waypoints;
  const auto& arcs = routes_[c].arcs;
  std::vector<VertId> path{waypoints[0]};
  for (VertId v : waypoints) is_on_path_[v.index()] = 1;
  bool found = true;
  for (std::size_t k = 1; k < waypoints.size() && found; ++k) {
    found = route_segment({c, waypoints[k - 1], waypoints[k], arcs[k - 1], arcs[k]}, path);
    for (VertId v : path) is_on_path_[v.index()] = 1;
  }
  for (VertId v : waypoints) is_on_path_[v.index()] = 0;
  for (VertId v : path) is_on_path_[v.index()] = 0;
  if (found) routes_[c].path = std::move(path);
  return found;
}

bool CurveRouter::is_in_window(const Search& search, const TubeVert& t) const {
  const FeatureCurve& curve = in_.features.curves[search.curve];
  const double slack = kWindowSlack * in_.boundary.edge_length[t.vert];
  const auto is_in = [&](double arc) {
    return arc >= search.arc_lo - slack && arc <= search.arc_hi + slack;
  };
  if (is_in(t.arc)) return true;
  if (curve.verts.front() != curve.verts.back()) return false;
  return is_in(t.arc - curve.length()) || is_in(t.arc + curve.length());
}

bool CurveRouter::may_enter(const Search& search, VertId from, VertId to) const {
  if (to == search.target)
    return !(from == search.source && is_corner(from) && is_corner(to) &&
             is_taken_edge(from, to, search.curve));
  if (is_corner(to) || is_on_path_[to.index()] || tube_slot_[to.index()] < 0) return false;
  if (!is_sharing_allowed_ && occupancy_[to.index()] > 0) return false;
  return is_in_window(search,
                      in_.tubes[search.curve][static_cast<std::size_t>(tube_slot_[to.index()])]);
}

double CurveRouter::step_cost(const Search& search, VertId from, VertId to) const {
  const auto& tube = in_.tubes[search.curve];
  const auto distance_sq = [&](VertId v) {
    const int slot = tube_slot_[v.index()];
    if (slot < 0) return 1.0;  // a corner farther away than the tube
    const double d = tube[static_cast<std::size_t>(slot)].distance;
    return std::min(kMaxDistanceSq, d * d);
  };
  const double mean_sq = 0.5 * (distance_sq(from) + distance_sq(to));
  const double length = distance(in_.boundary.positions[from], in_.boundary.positions[to]);
  const double cost =
      length / in_.boundary.edge_length[from] * (1 + in_.options.distance_weight * mean_sq);
  if (is_corner(to)) return cost;
  return cost * (1 + pressure_ * occupancy_[to.index()]) + history_[to.index()];
}

/// Appends the cheapest way from source to target, without the source.
bool CurveRouter::route_segment(const Search& search, std::vector<VertId>& path) {
  std::vector<VertId> touched{search.source};
  std::priority_queue<QueueItem, std::vector<QueueItem>, std::greater<>> queue;
  cost_[search.source.index()] = 0;
  queue.push({0, search.source});
  bool found = false;
  while (!queue.empty() && !found) {
    const auto [cost, v] = queue.top();
    queue.pop();
    if (cost > cost_[v.index()]) continue;
    found = v == search.target;
    if (found) break;
    for (VertId w : in_.graph.neighbors(v)) {
      if (!may_enter(search, v, w)) continue;
      const double total = cost + step_cost(search, v, w);
      if (total >= cost_[w.index()]) continue;
      if (cost_[w.index()] == kInfinity) touched.push_back(w);
      cost_[w.index()] = total;
      from_[w.index()] = v;
      queue.push({total, w});
    }
  }
  const std::size_t begin = path.size();
  if (found)
    for (VertId v = search.target; v != search.source; v = from_[v.index()]) path.push_back(v);
  std::reverse(path.begin() + static_cast<std::ptrdiff_t>(begin), path.end());
  for (VertId v : touched) cost_[v.index()] = kInfinity;
  return found;
}

}  // namespace hexwright::fitting
