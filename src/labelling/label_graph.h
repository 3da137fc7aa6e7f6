// The labelling problem as a graph, shared by the solver's parts.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "labelling/labelling.h"

namespace hexwright::labelling {

using LabelMask = std::uint8_t;  ///< bit p: label p

/// One leaf in the solver's costs. Ties go to blocks with even centres, which touch fewer nodes of
/// the depth above: two per axis with their neighbours, not three. That rides in the low bits.
inline constexpr int kTieBits = 24;
inline constexpr std::int64_t kLeafCost = std::int64_t{1} << kTieBits;

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
  /// The allowed label of least cost; some label must be allowed.
  Parity cheapest_label(std::size_t node) const {
    Parity best = std::countr_zero(unsigned{allowed[node]});
    for (Parity p = best + 1; p < kNumParities; ++p)
      if ((allowed[node] >> p & 1) && costs[node][p] < costs[node][best]) best = p;
    return best;
  }
  std::int64_t least_cost(std::size_t node) const { return costs[node][cheapest_label(node)]; }
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

/// Connected groups of at least two nodes, each sorted.
std::vector<std::vector<std::uint32_t>> find_groups(const LabelGraph& graph);

/// Removes labels that some other label of the same node makes useless, and then edges that forbid
/// nothing any more; an optimal labelling stays. `groups`: as find_groups() gives them. Returns the
/// labels in an order of removal: replacing them in that order keeps any labelling feasible. Nodes
/// outside the groups lose all but one label and are not in the list.
std::vector<PrunedLabel> reduce_graph(LabelGraph& graph,
                                      const std::vector<std::vector<std::uint32_t>>& groups);

/// The group as a graph of its own, numbered in the group's order. `local`: each node's place in
/// its group.
LabelGraph subgraph(const LabelGraph& graph, const std::vector<std::uint32_t>& group,
                    const std::vector<std::uint32_t>& local);

/// A cost that no labelling reaches: of a graph whose nodes have no compatible labels.
inline constexpr std::int64_t kInfeasibleCost = std::numeric_limits<std::int64_t>::max() / 4;

/// Exact, by eliminating one node after the other; absent when a table would exceed the limit.
/// Without labels and of cost kInfeasibleCost when the allowed labels exclude each other.
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

/// By message passing: for groups of any size, mostly the optimum. What the messages leave is tried
/// by elimination with tables up to the limit.
SearchResult solve_large_group(const LabelGraph& graph, const Labelling& start,
                               std::size_t table_entries);

/// Improves a labelling of a group of any size: parts of it are solved exactly while the labels
/// around them stay.
void improve_by_parts(const LabelGraph& graph, Labelling& labelling);

/// The best single label for all nodes, improved node by node. All labels must be allowed.
Labelling make_start(const LabelGraph& graph);

}  // namespace hexwright::labelling
