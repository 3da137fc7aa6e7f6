// The labelling solver's driver: groups, pruning, exact methods.
#include "labelling/labelling.h"

#include <algorithm>
#include <numeric>

#include "hexwright/base/parallel.h"

#include "labelling/label_graph.h"

namespace hexwright::labelling {
namespace {

// Groups whose tables stay below this go to elimination without further ado.
constexpr std::size_t kSmallTable = 4096;

std::int64_t with_tie_break(std::int64_t cost, Parity parity) {
  return cost * kLeafCost + std::popcount(static_cast<unsigned>(parity));
}

/// Both directions of every conflict, so that a node sees all its neighbours.
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

/// A feasible labelling with allowed labels only, to begin a search with.
Labelling feasible_start(const LabelGraph& unpruned, const std::vector<PrunedLabel>& pruned) {
  Labelling out = make_start(unpruned);
  for (const PrunedLabel& step : pruned)
    if (out.labels[step.node] == step.label) out.labels[step.node] = step.better;
  return out;
}

/// The part of a labelling that falls to a group, with its cost there.
Labelling restricted(const Labelling& all, const LabelGraph& graph,
                     const std::vector<std::uint32_t>& group) {
  Labelling out;
  for (std::size_t i = 0; i < group.size(); ++i) {
    out.labels.push_back(all.labels[group[i]]);
    out.cost += graph.costs[i][out.labels.back()];
  }
  return out;
}

/// By messages; what they leave open, by branch and bound up to some tens of nodes, where that has
/// a chance.
SearchResult search_group(const LabelGraph& graph, const Labelling& start,
                          const LabelLimits& limits) {
  constexpr std::size_t kLargestForSearch = 60;
  SearchResult large = solve_large_group(graph, start, limits.table_entries);
  if (large.is_optimal || graph.num_nodes() > kLargestForSearch) return large;
  SearchResult result = solve_by_search(graph, large.best, limits.search_nodes);
  result.lower_bound = std::max(result.lower_bound, large.lower_bound);
  result.is_optimal = result.best.cost / kLeafCost == result.lower_bound / kLeafCost;
  return result;
}

/// Every group by itself: by elimination where that is cheap, else by search from a labelling that
/// `make_start` gives for the whole graph.
template <class MakeStart>
std::vector<SearchResult> solve_groups(const LabelGraph& graph,
                                       const std::vector<std::vector<std::uint32_t>>& groups,
                                       MakeStart&& make_start, const LabelLimits& limits) {
  std::vector<std::uint32_t> local(graph.num_nodes());
  for (const auto& group : groups)
    for (std::uint32_t i = 0; i < group.size(); ++i) local[group[i]] = i;
  std::vector<SearchResult> results(groups.size());
  std::vector<char> is_open(groups.size(), 0);
  constexpr std::size_t kGroupsPerTask = 16;
  parallel_for(
      groups.size(),
      [&](std::size_t g) {
        const auto exact = solve_by_elimination(subgraph(graph, groups[g], local),
                                                std::min(limits.table_entries, kSmallTable));
        is_open[g] = !exact;
        if (exact) results[g] = {*exact, true, exact->cost};
      },
      kGroupsPerTask);
  if (std::find(is_open.begin(), is_open.end(), 1) == is_open.end()) return results;
  const Labelling start = make_start();  // rarely needed
  parallel_for(
      groups.size(),
      [&](std::size_t g) {
        if (!is_open[g]) return;
        const LabelGraph alone = subgraph(graph, groups[g], local);
        results[g] = search_group(alone, restricted(start, alone, groups[g]), limits);
      },
      1);
  return results;
}

}  // namespace

LabelSolution solve_labels(const std::vector<LabelCosts>& costs,
                           const std::vector<Conflict>& conflicts, const LabelLimits& limits) {
  LabelSolution out;
  out.labels.resize(costs.size());
  out.largest_group = costs.empty() ? 0 : 1;
  LabelGraph graph = make_graph(costs, conflicts);
  const auto all_groups = find_groups(graph);
  for (const auto& group : all_groups)
    out.largest_group = std::max(out.largest_group, group.size());
  const std::vector<PrunedLabel> pruned = reduce_graph(graph, all_groups);

  for (std::size_t u = 0; u < costs.size(); ++u) {
    if (!graph.edges[u].empty()) continue;
    out.labels[u] = static_cast<std::uint8_t>(graph.cheapest_label(u));
    out.lower_bound += costs[u][out.labels[u]];
  }
  const auto groups = find_groups(graph);
  const auto results = solve_groups(
      graph, groups, [&] { return feasible_start(make_graph(costs, conflicts), pruned); }, limits);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const SearchResult& result = results[g];
    for (std::size_t i = 0; i < groups[g].size(); ++i)
      out.labels[groups[g][i]] = result.best.labels[i];
    out.lower_bound += result.lower_bound / kLeafCost;
    out.is_optimal = out.is_optimal && result.is_optimal;
  }
  for (std::size_t u = 0; u < costs.size(); ++u) out.cost += costs[u][out.labels[u]];
  return out;
}

}  // namespace hexwright::labelling
