// Groups of clusters too large for elimination alone: message passing, a dive, and elimination in
// windows.
//
// The conflict graphs of clusters have tight or nearly tight bounds by messages, so a good
// labelling is mostly proven to be the best; where it is not, the gap is known.
//
// Based on: Savchynskyy, Kappes, Swoboda, Schnoerr, "Global MAP-optimality by shrinking the
// combinatorial search area with convex relaxation", NIPS 2013, for the labels left out.
#include <algorithm>

#include "hexwright/base/cancel.h"

#include "labelling/label_messages.h"

namespace hexwright::labelling {
namespace {

// Work is counted in edges visited, not in seconds, so that results do not depend on the machine.
// Small groups may use what it takes to prove the optimum, huge ones a fixed number of passes.
constexpr std::size_t kMaxWork = 400'000;
constexpr int kMinPasses = 48, kMaxPasses = 400, kFirstDive = 16;

/// Domains that shrink as labels are chosen, kept arc consistent, with undo.
class Domains {
 public:
  Domains(const LabelGraph& graph, std::vector<LabelMask> masks)
      : graph_(graph), masks_(std::move(masks)) {}

  LabelMask mask(std::uint32_t node) const { return masks_[node]; }

  /// Narrows a node to these labels and its surroundings accordingly; without effect and false when
  /// some node would be left without a label.
  bool narrow(std::uint32_t node, LabelMask to) {
    trail_.clear();
    queue_.assign(1, node);
    set(node, to);
    bool is_consistent = to != 0;
    for (std::size_t i = 0; i < queue_.size() && is_consistent; ++i)
      for (const LabelEdge& e : graph_.edges[queue_[i]]) {
        const LabelMask kept = supported(e.other, queue_[i]);
        if (kept == masks_[e.other]) continue;
        set(e.other, kept);
        queue_.push_back(e.other);
        if (kept == 0) {
          is_consistent = false;
          break;
        }
      }
    if (!is_consistent)
      for (auto t = trail_.rbegin(); t != trail_.rend(); ++t) masks_[t->first] = t->second;
    return is_consistent;
  }

 private:
  void set(std::uint32_t node, LabelMask to) {
    trail_.push_back({node, masks_[node]});
    masks_[node] = to;
  }
  /// Labels of `node` that some label of `by` allows.
  LabelMask supported(std::uint32_t node, std::uint32_t by) const {
    const auto& edges = graph_.edges[node];
    const auto e =
        std::lower_bound(edges.begin(), edges.end(), by,
                         [](const LabelEdge& a, std::uint32_t b) { return a.other < b; });
    LabelMask kept = masks_[node];
    for (Parity p = 0; p < kNumParities; ++p)
      if ((masks_[by] & ~e->forbids[p]) == 0) kept = static_cast<LabelMask>(kept & ~(1 << p));
    return kept;
  }

  const LabelGraph& graph_;
  std::vector<LabelMask> masks_;
  std::vector<std::pair<std::uint32_t, LabelMask>> trail_;
  std::vector<std::uint32_t> queue_;
};

/// An excess in whole leaves, so that ties are seen as such.
constexpr std::int64_t whole_leaves(std::int64_t excess) {
  return (excess + LabelMessages::kUnit / 2) / LabelMessages::kUnit;
}

/// A labelling that follows the messages: node after node takes the label of least excess that
/// leaves every other node a label. Absent when that leads to a dead end.
std::optional<Labelling> dive(const LabelGraph& graph, const LabelMessages& messages,
                              bool is_forward) {
  Domains domains(graph, graph.allowed);
  const auto count = static_cast<std::uint32_t>(graph.num_nodes());
  Labelling out;
  out.labels.resize(count);
  std::vector<std::pair<std::int64_t, Parity>> order;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t u = is_forward ? i : count - 1 - i;
    order.clear();
    for (Parity p = 0; p < kNumParities; ++p)
      if (domains.mask(u) >> p & 1)
        order.push_back(
            {whole_leaves(messages.excess(u, p)) * kLeafCost + graph.costs[u][p] % kLeafCost, p});
    std::sort(order.begin(), order.end());
    const auto chosen = std::find_if(order.begin(), order.end(), [&](const auto& entry) {
      return domains.narrow(u, static_cast<LabelMask>(1 << entry.second));
    });
    if (chosen == order.end()) return std::nullopt;
    out.labels[u] = static_cast<std::uint8_t>(chosen->second);
    out.cost += graph.costs[u][chosen->second];
  }
  return out;
}

/// The cheapest labelling with the labels that the messages leave; absent when that takes too much
/// room, of cost kInfeasibleCost when there is none.
std::optional<Labelling> solve_rest(const LabelGraph& graph, const LabelMessages& messages,
                                    std::size_t table_entries) {
  LabelGraph rest = graph;
  for (std::size_t u = 0; u < graph.num_nodes(); ++u)
    rest.allowed[u] = static_cast<LabelMask>(rest.allowed[u] & messages.allowed(u));
  reduce_graph(rest, find_groups(rest));
  return solve_by_elimination(rest, table_entries);
}

bool is_proven(const SearchResult& result) {
  return result.best.cost / kLeafCost <= result.lower_bound / kLeafCost;
}

int num_passes(const LabelMessages& messages) {
  const std::size_t affordable = kMaxWork / std::max<std::size_t>(1, messages.num_half_edges());
  return std::clamp(static_cast<int>(std::min<std::size_t>(kMaxPasses, affordable)), kMinPasses,
                    kMaxPasses);
}

}  // namespace

SearchResult solve_large_group(const LabelGraph& graph, const Labelling& start,
                               std::size_t table_entries) {
  LabelMessages messages(graph);
  SearchResult out;
  out.best = start;
  const int last_pass = num_passes(messages);
  int next_dive = kFirstDive;
  for (int pass = 1; pass <= last_pass && !is_proven(out); ++pass) {
    check_cancelled();
    const bool is_forward = pass % 2 == 0;
    const std::int64_t bound =
        messages.pass(is_forward) ? messages.bound() * kLeafCost : out.best.cost;
    out.lower_bound = std::max(out.lower_bound, std::min(bound, out.best.cost));
    // Dives get rarer as the bound slows down; always one forwards and one backwards.
    if (pass != next_dive && pass != next_dive + 1) continue;
    const auto found = dive(graph, messages, is_forward);
    if (found && found->cost < out.best.cost) out.best = *found;
    if (pass == next_dive) continue;
    messages.drop_labels_from(out.best.cost / kLeafCost);
    next_dive *= 2;
  }
  if (!is_proven(out)) improve_by_parts(graph, out.best);
  if (!is_proven(out)) {
    messages.drop_labels_from(out.best.cost / kLeafCost);
    if (const auto rest = solve_rest(graph, messages, table_entries)) {
      if (rest->cost < out.best.cost) out.best = *rest;
      out.lower_bound = out.best.cost;  // labels left out are in no cheaper labelling
    }
  }
  out.is_optimal = is_proven(out);
  return out;
}

}  // namespace hexwright::labelling
