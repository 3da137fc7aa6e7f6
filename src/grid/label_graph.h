// The labelling problem as a graph, shared by the solver's parts.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "grid/labelling.h"

namespace hexwright {

using LabelMask = std::uint8_t;  ///< bit p: label p

/// One cluster's view of a conflict: the labels of the other that each own label forbids.
struct LabelEdge {
  std::uint32_t other = 0;
  std::array<LabelMask, kNumParities> forbids{};
};

struct LabelGraph {
  std::vector<LabelCosts> costs;
  std::vector<std::vector<LabelEdge>> edges;
  std::vector<LabelMask> allowed;  ///< labels still possible

  std::size_t num_nodes() const { return costs.size(); }
  std::int64_t least_cost(std::size_t node) const {
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (Parity p = 0; p < kNumParities; ++p)
      if (allowed[node] >> p & 1) least = std::min(least, costs[node][p]);
    return least;
  }
};

/// Labels per node and their total cost.
struct Labelling {
  std::vector<std::uint8_t> labels;
  std::int64_t cost = 0;
};

/// A label that was dropped because another of the same node can always take its place.
struct PrunedLabel {
  std::uint32_t node = 0;
  std::uint8_t label = 0, better = 0;
};

/// Removes labels that some other label of the same node makes useless; an optimal labelling stays.
/// Returns them in order of removal: replacing them in that order keeps any labelling feasible.
std::vector<PrunedLabel> prune_labels(LabelGraph& graph);

/// Exact, by eliminating one node after the other; absent when a table would exceed the limit.
std::optional<Labelling> solve_by_elimination(const LabelGraph& graph, std::size_t table_entries);

struct SearchResult {
  Labelling best;
  bool is_optimal = false;
  std::int64_t lower_bound = 0;
};

/// Branch and bound from a feasible start; past the node limit the best labelling found and a
/// bound.
SearchResult solve_by_search(const LabelGraph& graph, const Labelling& start,
                             std::size_t max_nodes);

/// For groups of any size: a labelling improved part by part, and the bound of the parts alone.
SearchResult solve_by_parts(const LabelGraph& graph, const Labelling& start);

/// The best single label for all nodes, improved node by node. All labels must be allowed.
Labelling make_start(const LabelGraph& graph);

}  // namespace hexwright
