// Random conflicts between the nodes of a label graph, and what they forbid.
#pragma once

#include <random>
#include <vector>

#include "labelling/label_graph.h"

namespace hexwright::labelling::test {

/// Joins each pair of nodes with probability `edge_share`; such an edge forbids all unequal labels
/// but one in `one_in`. Needs `edges` of the graph's size.
inline void add_conflicts(std::mt19937& rng, LabelGraph& graph, double edge_share,
                          unsigned one_in) {
  std::uniform_real_distribution<> uniform(0, 1);
  const auto num_nodes = static_cast<std::uint32_t>(graph.edges.size());
  for (std::uint32_t u = 0; u < num_nodes; ++u)
    for (std::uint32_t v = u + 1; v < num_nodes; ++v) {
      if (uniform(rng) > edge_share) continue;
      LabelEdge forward{v, {}}, backward{u, {}};
      for (Parity p = 0; p < kNumParities; ++p)
        for (Parity q = 0; q < kNumParities; ++q) {
          if (p == q || rng() % one_in == 0) continue;
          forward.forbids[p] = static_cast<LabelMask>(forward.forbids[p] | 1 << q);
          backward.forbids[q] = static_cast<LabelMask>(backward.forbids[q] | 1 << p);
        }
      graph.edges[u].push_back(forward);
      graph.edges[v].push_back(backward);
    }
}

/// Whether every label is allowed at its node and no edge forbids a pair.
inline bool is_feasible(const LabelGraph& graph, const std::vector<std::uint8_t>& labels) {
  for (std::size_t u = 0; u < graph.num_nodes(); ++u) {
    if (!(graph.allowed[u] >> labels[u] & 1)) return false;
    for (const LabelEdge& e : graph.edges[u])
      if (e.forbids[labels[u]] >> labels[e.other] & 1) return false;
  }
  return true;
}

}  // namespace hexwright::labelling::test
