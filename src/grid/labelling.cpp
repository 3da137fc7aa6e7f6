// The labelling solver's driver: groups, pruning, exact methods.
#include "grid/labelling.h"

#include <algorithm>
#include <numeric>

#include "grid/label_graph.h"

namespace hexwright {
namespace {

// Ties go to blocks with even centres, which touch fewer nodes of the depth above: two per axis
// with their neighbours, not three. The tie-break rides in the low bits of the costs.
constexpr int kTieBits = 24;

std::int64_t with_tie_break(std::int64_t cost, Parity parity) {
  return (cost << kTieBits) + std::popcount(static_cast<unsigned>(parity));
}

std::uint8_t cheapest_label(const LabelCosts& costs) {
  return static_cast<std::uint8_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
}

LabelGraph make_graph(const std::vector<LabelCosts>& costs,
                      const std::vector<Conflict>& conflicts) {
  LabelGraph graph;
  graph.costs = costs;
  for (LabelCosts& c : graph.costs)
    for (Parity p = 0; p < kNumParities; ++p) c[p] = with_tie_break(c[p], p);
  graph.edges.resize(costs.size());
  graph.allowed.assign(costs.size(), 0xff);
  for (const Conflict& c : conflicts) {
    LabelEdge forward{c.second, {}}, backward{c.first, {}};
    for (Parity p = 0; p < kNumParities; ++p)
      for (Parity q = 0; q < kNumParities; ++q)
        if (c.forbidden >> (8 * p + q) & 1) {
          forward.forbids[p] = static_cast<LabelMask>(forward.forbids[p] | 1 << q);
          backward.forbids[q] = static_cast<LabelMask>(backward.forbids[q] | 1 << p);
        }
    graph.edges[c.first].push_back(forward);
    graph.edges[c.second].push_back(backward);
  }
  return graph;
}

/// Connected groups of at least two nodes, each sorted.
std::vector<std::vector<std::uint32_t>> find_groups(const LabelGraph& graph) {
  std::vector<std::vector<std::uint32_t>> groups;
  std::vector<char> is_seen(graph.num_nodes(), 0);
  for (std::uint32_t start = 0; start < graph.num_nodes(); ++start) {
    if (is_seen[start] || graph.edges[start].empty()) continue;
    std::vector<std::uint32_t> group = {start};
    is_seen[start] = 1;
    for (std::size_t i = 0; i < group.size(); ++i)
      for (const LabelEdge& e : graph.edges[group[i]])
        if (!is_seen[e.other]) {
          is_seen[e.other] = 1;
          group.push_back(e.other);
        }
    std::sort(group.begin(), group.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

/// The group as a graph of its own, numbered in the group's order.
LabelGraph subgraph(const LabelGraph& graph, const std::vector<std::uint32_t>& group,
                    std::vector<std::uint32_t>& local) {
  LabelGraph out;
  for (std::uint32_t i = 0; i < group.size(); ++i) local[group[i]] = i;
  for (const std::uint32_t node : group) {
    out.costs.push_back(graph.costs[node]);
    out.allowed.push_back(graph.allowed[node]);
    out.edges.push_back(graph.edges[node]);
    for (LabelEdge& e : out.edges.back()) e.other = local[e.other];
  }
  return out;
}

/// Drops the edges that no longer forbid anything, so that pruned groups fall apart.
void drop_idle_edges(LabelGraph& graph) {
  for (std::size_t u = 0; u < graph.num_nodes(); ++u)
    std::erase_if(graph.edges[u], [&](const LabelEdge& e) {
      for (Parity p = 0; p < kNumParities; ++p)
        if ((graph.allowed[u] >> p & 1) && (e.forbids[p] & graph.allowed[e.other])) return false;
      return true;
    });
}

void solve_group(const LabelGraph& graph, const std::vector<std::uint32_t>& group,
                 const LabelLimits& limits, LabelSolution& out) {
  SearchResult result;
  if (auto exact = solve_by_elimination(graph, limits.table_entries)) {
    result.best = std::move(*exact);
    result.is_optimal = true;
    result.lower_bound = result.best.cost;
  } else {
    result = solve_by_search(graph, limits.search_nodes);
  }
  for (std::size_t i = 0; i < group.size(); ++i) out.labels[group[i]] = result.best.labels[i];
  out.lower_bound += result.lower_bound >> kTieBits;
  out.is_optimal = out.is_optimal && result.is_optimal;
}

}  // namespace

LabelSolution solve_labels(const std::vector<LabelCosts>& costs,
                           const std::vector<Conflict>& conflicts, const LabelLimits& limits) {
  LabelSolution out;
  out.labels.resize(costs.size());
  out.largest_group = costs.empty() ? 0 : 1;
  LabelGraph graph = make_graph(costs, conflicts);
  for (const auto& group : find_groups(graph))
    out.largest_group = std::max(out.largest_group, group.size());
  prune_labels(graph);
  drop_idle_edges(graph);

  std::vector<std::uint32_t> local(costs.size());
  for (std::size_t u = 0; u < costs.size(); ++u) {
    if (!graph.edges[u].empty()) continue;
    LabelCosts remaining = graph.costs[u];
    for (Parity p = 0; p < kNumParities; ++p)
      if (!(graph.allowed[u] >> p & 1)) remaining[p] = std::numeric_limits<std::int64_t>::max();
    out.labels[u] = cheapest_label(remaining);
    out.lower_bound += costs[u][out.labels[u]];
  }
  for (const auto& group : find_groups(graph))
    solve_group(subgraph(graph, group, local), group, limits, out);
  for (std::size_t u = 0; u < costs.size(); ++u) out.cost += costs[u][out.labels[u]];
  return out;
}

}  // namespace hexwright
