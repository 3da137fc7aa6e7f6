// Improves labellings of groups of clusters too large for exact search, part by part.
#include <algorithm>
#include <numeric>

#include "labelling/label_graph.h"

namespace hexwright::labelling {
namespace {

// Large enough to move whole knots of conflicts, small enough that nearly every part's tables fit.
constexpr std::size_t kPartSize = 24;
constexpr std::size_t kTableEntries = std::size_t{1} << 12;
constexpr int kRounds = 2;

using Part = std::vector<std::uint32_t>;

/// Breadth-first parts of at most kPartSize nodes, the first of them smaller in later rounds so
/// that the borders between parts move.
std::vector<Part> make_parts(const LabelGraph& graph, int round) {
  std::vector<Part> parts;
  std::vector<char> is_taken(graph.num_nodes(), 0);
  std::size_t size = kPartSize - static_cast<std::size_t>(round) * kPartSize / kRounds;
  for (std::uint32_t start = 0; start < graph.num_nodes(); ++start) {
    if (is_taken[start]) continue;
    is_taken[start] = 1;
    Part part(1, start);
    for (std::size_t i = 0; i < part.size(); ++i)
      for (const LabelEdge& e : graph.edges[part[i]])
        if (!is_taken[e.other] && part.size() < size) {
          is_taken[e.other] = 1;
          part.push_back(e.other);
        }
    std::sort(part.begin(), part.end());
    parts.push_back(std::move(part));
    size = kPartSize;
  }
  return parts;
}

/// The part alone, with the labels that those around it, as labelled, leave it.
LabelGraph part_graph(const LabelGraph& graph, const Part& part, const Labelling& around) {
  LabelGraph out;
  for (const std::uint32_t node : part) {
    LabelMask allowed = graph.allowed[node];
    std::vector<LabelEdge> inner;
    for (const LabelEdge& e : graph.edges[node]) {
      const auto found = std::lower_bound(part.begin(), part.end(), e.other);
      if (found != part.end() && *found == e.other) {
        inner.push_back(e);
        inner.back().other = static_cast<std::uint32_t>(found - part.begin());
      } else {
        for (Parity p = 0; p < kNumParities; ++p)
          if (e.forbids[p] >> around.labels[e.other] & 1)
            allowed = static_cast<LabelMask>(allowed & ~(1 << p));
      }
    }
    out.costs.push_back(graph.costs[node]);
    out.edges.push_back(std::move(inner));
    out.allowed.push_back(allowed);
  }
  return out;
}

/// Solves the part exactly while the labels around it stay, and keeps the result if it is cheaper.
/// Labels outside are respected through part_graph()'s masks, so the whole stays feasible.
void improve_part(const LabelGraph& graph, const Part& part, Labelling& at) {
  const LabelGraph alone = part_graph(graph, part, at);
  for (const LabelMask allowed : alone.allowed)
    if (allowed == 0) return;
  const auto exact = solve_by_elimination(alone, kTableEntries);
  if (!exact) return;
  std::int64_t before = 0;
  for (const std::uint32_t node : part) before += graph.costs[node][at.labels[node]];
  if (exact->cost >= before) return;
  at.cost += exact->cost - before;
  for (std::size_t i = 0; i < part.size(); ++i) at.labels[part[i]] = exact->labels[i];
}

}  // namespace

void improve_by_parts(const LabelGraph& graph, Labelling& labelling) {
  for (int round = 0; round < kRounds; ++round)
    for (const Part& part : make_parts(graph, round)) improve_part(graph, part, labelling);
}

}  // namespace hexwright::labelling
