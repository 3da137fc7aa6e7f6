// Groups of the labelling problem's graph.
#include "labelling/label_graph.h"

#include <algorithm>

namespace hexwright::labelling {

// Breadth first from the lowest node not seen yet, so groups are ordered by their first node.
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

LabelGraph subgraph(const LabelGraph& graph, const std::vector<std::uint32_t>& group,
                    const std::vector<std::uint32_t>& local) {
  LabelGraph out;
  for (const std::uint32_t node : group) {
    out.costs.push_back(graph.costs[node]);
    out.allowed.push_back(graph.allowed[node]);
    out.edges.push_back(graph.edges[node]);
    for (LabelEdge& e : out.edges.back()) e.other = local[e.other];
  }
  return out;
}

}  // namespace hexwright::labelling
