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

/// A feasible labelling with allowed labels only, to begin a search with.
Labelling feasible_start(const LabelGraph& unpruned, const std::vector<PrunedLabel>& pruned) {
  Labelling out = make_start(unpruned);
  for (const PrunedLabel& step : pruned)
    if (out.labels[step.node] == step.label) out.labels[step.node] = step.better;
  return out;
}

Labelling restricted(const Labelling& all, const LabelGraph& graph,
                     const std::vector<std::uint32_t>& group) {
  Labelling out;
  for (std::size_t i = 0; i < group.size(); ++i) {
    out.labels.push_back(all.labels[group[i]]);
    out.cost += graph.costs[i][out.labels.back()];
  }
  return out;
}

/// By branch and bound up to some tens of nodes, where it has a chance, else part by part.
SearchResult search_group(const LabelGraph& graph, const Labelling& start, std::size_t max_nodes) {
  constexpr std::size_t kLargestForSearch = 100;
  if (graph.num_nodes() > kLargestForSearch) return solve_by_parts(graph, start);
  SearchResult result = solve_by_search(graph, start, max_nodes);
  if (result.is_optimal) return result;
  SearchResult parts = solve_by_parts(graph, result.best);
  parts.lower_bound = std::max(parts.lower_bound, result.lower_bound);
  return parts;
}

void take_group(const SearchResult& result, const std::vector<std::uint32_t>& group,
                LabelSolution& out) {
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
  const std::vector<PrunedLabel> pruned = prune_labels(graph);
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
  std::optional<Labelling> start;  // rarely needed
  for (const auto& group : find_groups(graph)) {
    const LabelGraph alone = subgraph(graph, group, local);
    if (auto exact = solve_by_elimination(alone, limits.table_entries)) {
      take_group({*exact, true, exact->cost}, group, out);
      continue;
    }
    if (!start) start = feasible_start(make_graph(costs, conflicts), pruned);
    take_group(search_group(alone, restricted(*start, alone, group), limits.search_nodes), group,
               out);
  }
  for (std::size_t u = 0; u < costs.size(); ++u) out.cost += costs[u][out.labels[u]];
  return out;
}

}  // namespace hexwright
