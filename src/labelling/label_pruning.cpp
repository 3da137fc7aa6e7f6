// Labels that no best labelling needs: dominance and arc consistency until nothing changes.
//
// Based on: Desmet et al., "The dead-end elimination theorem and its use in protein side-chain
// positioning", Nature 356, 1992. Differs: pair costs are hard exclusions only.
#include <algorithm>

#include "hexwright/base/parallel.h"

#include "labelling/label_graph.h"

namespace hexwright::labelling {
namespace {

/// Whether `better` can replace `label` of a node in every labelling at no cost.
bool dominates(const LabelGraph& graph, std::size_t node, Parity better, Parity label) {
  const LabelCosts& c = graph.costs[node];
  if (c[better] > c[label]) return false;
  for (const LabelEdge& e : graph.edges[node])
    if (e.forbids[better] & ~e.forbids[label] & graph.allowed[e.other]) return false;
  return true;
}

bool prune_node(LabelGraph& graph, std::uint32_t node, std::vector<PrunedLabel>& pruned) {
  LabelMask& allowed = graph.allowed[node];
  const LabelMask before = allowed;
  for (Parity label = 0; label < kNumParities; ++label) {
    if (!(allowed >> label & 1)) continue;
    for (const LabelEdge& e : graph.edges[node])  // excluded by every choice of a neighbour
      if ((graph.allowed[e.other] & ~e.forbids[label]) == 0)
        allowed = static_cast<LabelMask>(allowed & ~(1 << label));
    if (!(allowed >> label & 1)) continue;
    for (Parity better = 0; better < kNumParities; ++better) {
      if (better == label || !(allowed >> better & 1)) continue;
      if (dominates(graph, node, better, label)) {
        pruned.push_back(
            {node, static_cast<std::uint8_t>(label), static_cast<std::uint8_t>(better)});
        allowed = static_cast<LabelMask>(allowed & ~(1 << label));
        break;
      }
    }
  }
  return allowed != before;
}

/// Drops the edges that no longer forbid anything, so that pruned groups fall apart.
void drop_idle_edges(LabelGraph& graph) {
  parallel_for(graph.num_nodes(), [&](std::size_t u) {
    std::erase_if(graph.edges[u], [&](const LabelEdge& e) {
      for (Parity p = 0; p < kNumParities; ++p)
        if ((graph.allowed[u] >> p & 1) && (e.forbids[p] & graph.allowed[e.other])) return false;
      return true;
    });
  });
}

/// Prunes nodes that no edge joins to others, until nothing changes. `is_queued` is the whole
/// graph's; it must be zero for these nodes, and is again afterwards.
std::vector<PrunedLabel> prune_group(LabelGraph& graph, std::vector<std::uint32_t> queue,
                                     std::vector<char>& is_queued) {
  std::vector<PrunedLabel> pruned;
  for (const std::uint32_t u : queue) is_queued[u] = 1;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const std::uint32_t u = queue[i];
    is_queued[u] = 0;
    if (!prune_node(graph, u, pruned)) continue;
    for (const LabelEdge& e : graph.edges[u])
      if (!is_queued[e.other]) {
        is_queued[e.other] = 1;
        queue.push_back(e.other);
      }
  }
  return pruned;
}

}  // namespace

std::vector<PrunedLabel> reduce_graph(LabelGraph& graph,
                                      const std::vector<std::vector<std::uint32_t>>& groups) {
  std::vector<char> is_queued(graph.num_nodes(), 0);
  parallel_for(graph.num_nodes(), [&](std::size_t u) {
    std::vector<PrunedLabel> none_to_replace;
    if (graph.edges[u].empty()) prune_node(graph, static_cast<std::uint32_t>(u), none_to_replace);
  });
  // Groups are independent, and one group's labels go in the order of its own queue.
  std::vector<std::vector<PrunedLabel>> by_group(groups.size());
  constexpr std::size_t kGroupsPerTask = 64;
  parallel_for(
      groups.size(), [&](std::size_t g) { by_group[g] = prune_group(graph, groups[g], is_queued); },
      kGroupsPerTask);
  drop_idle_edges(graph);
  std::vector<PrunedLabel> pruned;
  for (const auto& list : by_group) pruned.insert(pruned.end(), list.begin(), list.end());
  return pruned;
}

}  // namespace hexwright::labelling
