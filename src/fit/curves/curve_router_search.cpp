// The shortest path searches of the curve router: Dijkstra in the tube, in layers. A path moves to
// the next layer where it passes the next gate of the curve, so that it cannot cut a winding curve
// short; which vertex it passes the gate at is free.
#include <algorithm>
#include <limits>
#include <queue>

#include "fit/curves/curve_router.h"

namespace hexwright::fitting {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kWindowSlack = 3;     // edge lengths beyond a layer's gates
constexpr double kMaxDistanceSq = 4;   // a vertex farther than two edge lengths costs no more
constexpr std::size_t kLeastLoop = 4;  // edges
constexpr int kMaxRepeats = 8;         // searches for a way that passes no vertex twice

struct QueueItem {
  double cost;
  int state;
  friend bool operator>(const QueueItem& x, const QueueItem& y) {
    return x.cost != y.cost ? x.cost > y.cost : x.state > y.state;
  }
};

/// Drops a common stem of a loop's start and end.
void drop_stem(std::vector<VertId>& path) {
  while (path.size() > 3 && path[1] == path[path.size() - 2]) {
    path.erase(path.begin());
    path.pop_back();
  }
}

bool is_simple(const std::vector<VertId>& path) {
  std::vector<VertId> sorted(path.begin(), path.end() - 1);
  if (path.front() != path.back()) sorted.push_back(path.back());
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

}  // namespace

struct CurveRouter::Search {
  const CurveRouter& router;
  CurveId curve;
  const Route& route;
  std::vector<TubeVert> nodes;  // the tube, and ends that are not in it
  int num_layers;
  std::vector<double> cost;  // per state = layer * nodes + node
  std::vector<int> from;
  std::vector<char> is_closed_off;  // states that an earlier way passed its vertex again in

  int num_nodes() const { return static_cast<int>(nodes.size()); }
  const TubeVert& node(int state) const {
    return nodes[static_cast<std::size_t>(state % num_nodes())];
  }
  double size(const TubeVert& t) const { return router.in_.boundary.edge_length[t.vert]; }

  /// The arc from the path's start, or that plus or minus a loop's length, is in an interval.
  bool is_near(const TubeVert& t, double lo, double hi) const {
    const FeatureCurve& c = router.in_.features.curves[curve];
    const double arc = t.arc - route.start_arc;
    if (arc >= lo && arc <= hi) return true;
    if (c.verts.front() != c.verts.back()) return false;
    return (arc + c.length() >= lo && arc + c.length() <= hi) ||
           (arc - c.length() >= lo && arc - c.length() <= hi);
  }

  bool is_in_layer(const TubeVert& t, int layer) const {
    const auto k = static_cast<std::size_t>(layer);
    const double slack = kWindowSlack * size(t);
    return is_near(t, route.gates[k] - slack, route.gates[k + 1] + slack);
  }

  /// At the gate between a layer and the next.
  bool is_at_gate(const TubeVert& t, int layer) const {
    const auto k = static_cast<std::size_t>(layer);
    const double gate = route.gates[k + 1];
    const double shorter = std::min(gate - route.gates[k], route.gates[k + 2] - gate);
    const double width = std::min(size(t), 0.25 * shorter);
    return is_near(t, gate - width, gate + width);
  }
};

bool CurveRouter::may_enter(const Search& search, VertId from, VertId to) const {
  const Route& r = search.route;
  if (to == r.target)
    return !(from == r.source && is_corner(from) && is_corner(to) &&
             is_taken_edge(from, to, search.curve));
  if (is_corner(to) || to == r.source || tube_slot_[to.index()] < 0) return false;
  return is_sharing_allowed_ || occupancy_[to.index()] == 0;
}

double CurveRouter::step_cost(const Search& search, VertId from, VertId to) const {
  const auto distance_sq = [&](VertId v) {
    const double d = search.nodes[static_cast<std::size_t>(tube_slot_[v.index()])].distance;
    return std::min(kMaxDistanceSq, d * d);
  };
  const double mean_sq = 0.5 * (distance_sq(from) + distance_sq(to));
  const double length = distance(in_.boundary.positions[from], in_.boundary.positions[to]);
  const double cost =
      length / in_.boundary.edge_length[from] * (1 + in_.options.distance_weight * mean_sq);
  if (is_corner(to)) return cost;
  return cost * (1 + pressure_ * occupancy_[to.index()]) + history_[to.index()];
}

/// Fills the curve's path with the cheapest way; false (and no path) when there is none.
bool CurveRouter::route(CurveId c) {
  const Route& r = routes_[c];
  Search search{*this, c, r, in_.tubes[c], static_cast<int>(r.gates.size()) - 1, {}, {}, {}};
  for (std::size_t i = 0; i < search.nodes.size(); ++i)
    tube_slot_[search.nodes[i].vert.index()] = static_cast<int>(i);
  const double length = in_.features.curves[c].length();
  for (const auto& [end, arc] : {std::pair{r.source, 0.0}, std::pair{r.target, length}})
    if (tube_slot_[end.index()] < 0) {  // a corner may be farther away than the tube
      tube_slot_[end.index()] = search.num_nodes();
      search.nodes.push_back({end, 1.0, arc});
    }
  std::vector<VertId> path = find_simple_path(search);
  for (const TubeVert& t : search.nodes) tube_slot_[t.vert.index()] = -1;
  if (path.size() < 2) return false;
  if (path.front() == path.back() && path.size() <= kLeastLoop) return false;
  routes_[c].path = std::move(path);
  return true;
}

/// A way in layers may pass a vertex in two of them, where the curve comes back close to itself, as
/// at the corner of a loop that ends in a narrow wedge. Then the later passage is closed off and
/// the search done again; loops without a corner start elsewhere instead. Empty when there is none.
std::vector<VertId> CurveRouter::find_simple_path(Search& search) const {
  const auto num_states = static_cast<std::size_t>(search.num_nodes() * search.num_layers);
  search.is_closed_off.assign(num_states, 0);
  const bool is_closed = in_.features.curves[search.curve].is_closed;
  for (int k = 0; k < kMaxRepeats; ++k) {
    const std::vector<int> states = find_path(search);
    std::vector<VertId> path = verts_of(search, states);
    if (path.size() < 2) return {};
    if (is_closed) drop_stem(path);
    if (is_simple(path)) return path;
    if (is_closed || !close_off_repeats(search, states)) return {};
  }
  return {};
}

/// Of a way's states; those that differ by their layer alone are one vertex.
std::vector<VertId> CurveRouter::verts_of(const Search& search, const std::vector<int>& states) {
  std::vector<VertId> path;
  for (int state : states) {
    const VertId v = search.node(state).vert;
    if (path.empty() || path.back() != v) path.push_back(v);
  }
  return path;
}

/// Closes the states of a way whose vertex it has left before, but for its ends.
bool CurveRouter::close_off_repeats(Search& search, const std::vector<int>& states) {
  bool any = false;
  std::vector<char> is_passed(static_cast<std::size_t>(search.num_nodes()), 0);
  for (std::size_t i = 1; i + 1 < states.size(); ++i) {
    const VertId v = search.node(states[i]).vert;
    if (v == search.route.source || v == search.route.target) continue;
    if (v == search.node(states[i - 1]).vert) continue;  // only the layer changed
    char& passed = is_passed[static_cast<std::size_t>(states[i] % search.num_nodes())];
    if (passed) {
      search.is_closed_off[static_cast<std::size_t>(states[i])] = 1;
      any = true;
    }
    passed = 1;
  }
  return any;
}

/// The states of the cheapest way, from the source on; empty when there is none.
std::vector<int> CurveRouter::find_path(Search& search) const {
  const Route& r = search.route;
  const int n = search.num_nodes();
  search.cost.assign(static_cast<std::size_t>(n * search.num_layers), kInfinity);
  search.from.assign(search.cost.size(), -1);
  std::priority_queue<QueueItem, std::vector<QueueItem>, std::greater<>> queue;
  const auto reach = [&](int state, double cost, int from) {
    double& known = search.cost[static_cast<std::size_t>(state)];
    if (cost >= known || search.is_closed_off[static_cast<std::size_t>(state)]) return;
    known = cost;
    search.from[static_cast<std::size_t>(state)] = from;
    queue.push({cost, state});
  };
  reach(tube_slot_[r.source.index()], 0, -1);
  while (!queue.empty()) {
    const auto [cost, state] = queue.top();
    queue.pop();
    if (cost > search.cost[static_cast<std::size_t>(state)]) continue;
    const int layer = state / n;
    const bool is_last = layer + 1 == search.num_layers;
    const VertId v = search.node(state).vert;
    const bool has_left = search.from[static_cast<std::size_t>(state)] >= 0;
    if (v == r.target && is_last && has_left) return trace(search, state);
    if (v == r.target && has_left) continue;
    if (!is_last && search.is_at_gate(search.node(state), layer)) reach(state + n, cost, state);
    for (VertId w : in_.graph.neighbors(v)) {
      if (!may_enter(search, v, w)) continue;
      if (w == r.target && !is_last) continue;
      const int slot = tube_slot_[w.index()];
      const TubeVert& t = search.nodes[static_cast<std::size_t>(slot)];
      if (w != r.target && !search.is_in_layer(t, layer)) continue;
      reach(layer * n + slot, cost + step_cost(search, v, w), state);
    }
  }
  return {};
}

std::vector<int> CurveRouter::trace(const Search& search, int state) const {
  std::vector<int> states;
  for (; state >= 0; state = search.from[static_cast<std::size_t>(state)]) states.push_back(state);
  std::reverse(states.begin(), states.end());
  return states;
}

}  // namespace hexwright::fitting
