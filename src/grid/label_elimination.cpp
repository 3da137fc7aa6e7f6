// Exact parts of the labelling solver: dominance and variable elimination.
//
// Based on: Dechter, "Bucket elimination: a unifying framework for reasoning", Artificial
// Intelligence 113, 1999; dead-end elimination with hard constraints for the pruning.
#include <algorithm>

#include "grid/label_graph.h"

namespace hexwright {
namespace {

constexpr std::int64_t kInfeasible = std::numeric_limits<std::int64_t>::max() / 4;

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

/// A cost table over a few nodes; the first node of the scope varies fastest.
struct Factor {
  std::vector<std::uint32_t> scope;
  std::vector<std::int64_t> values;
};

/// What elimination of a node leaves behind to read its label from its neighbours'.
struct Bucket {
  std::uint32_t node = 0;
  std::vector<std::uint32_t> scope;
  std::vector<std::uint8_t> choice;  ///< index into the node's labels
};

class Elimination {
 public:
  Elimination(const LabelGraph& graph, std::size_t max_entries)
      : graph_(graph),
        max_entries_(max_entries),
        labels_(graph.num_nodes()),
        unary_(graph.num_nodes()),
        neighbours_(graph.num_nodes()),
        factors_(graph.num_nodes()) {
    for (std::uint32_t u = 0; u < graph.num_nodes(); ++u) {
      for (Parity p = 0; p < kNumParities; ++p)
        if (graph.allowed[u] >> p & 1) {
          labels_[u].push_back(static_cast<std::uint8_t>(p));
          unary_[u].push_back(graph.costs[u][p]);
        }
    }
    for (std::uint32_t u = 0; u < graph.num_nodes(); ++u)
      for (const LabelEdge& e : graph.edges[u]) {
        neighbours_[u].push_back(e.other);
        if (u < e.other) add_edge_factor(u, e);
      }
    for (auto& list : neighbours_) std::sort(list.begin(), list.end());
  }

  std::optional<Labelling> solve() {
    std::vector<char> is_done(graph_.num_nodes(), 0);
    std::int64_t total = 0;
    for (std::size_t step = 0; step < graph_.num_nodes(); ++step) {
      const std::uint32_t node = cheapest_node(is_done);
      if (table_size(node) > max_entries_) return std::nullopt;
      total += eliminate(node);
      is_done[node] = 1;
    }
    return read_back(total);
  }

 private:
  void add_edge_factor(std::uint32_t u, const LabelEdge& e) {
    Factor f{{u, e.other}, {}};
    for (const std::uint8_t q : labels_[e.other])
      for (const std::uint8_t p : labels_[u])
        f.values.push_back(e.forbids[p] >> q & 1 ? kInfeasible : 0);
    add_factor(std::move(f));
  }

  void add_factor(Factor f) {
    const auto index = static_cast<std::uint32_t>(all_factors_.size());
    for (const std::uint32_t u : f.scope) factors_[u].push_back(index);
    all_factors_.push_back(std::move(f));
    is_used_.push_back(0);
  }

  /// Entries of the joint table of a node and its neighbours, capped.
  std::size_t table_size(std::uint32_t node) const {
    std::size_t size = labels_[node].size();
    for (const std::uint32_t v : neighbours_[node]) {
      size *= labels_[v].size();
      if (size > max_entries_) return max_entries_ + 1;
    }
    return size;
  }

  std::uint32_t cheapest_node(const std::vector<char>& is_done) const {
    std::uint32_t best = 0;
    std::size_t best_size = 0;
    bool has_best = false;
    for (std::uint32_t u = 0; u < graph_.num_nodes(); ++u) {
      if (is_done[u]) continue;
      const std::size_t size = table_size(u);
      if (has_best && size >= best_size) continue;
      best = u;
      best_size = size;
      has_best = true;
    }
    return best;
  }

  /// Removes a node; its cheapest completion becomes a factor over its neighbours. Returns the
  /// constant part when there are none.
  std::int64_t eliminate(std::uint32_t node) {
    const std::vector<std::uint32_t> scope = neighbours_[node];
    std::vector<std::uint32_t> used;
    for (const std::uint32_t f : factors_[node])
      if (!is_used_[f]) used.push_back(f);
    Factor message{scope, {}};
    Bucket bucket{node, scope, {}};
    std::vector<std::uint32_t> digits(scope.size(), 0);
    for (bool is_last = false; !is_last;) {
      std::int64_t least = kInfeasible;
      std::uint8_t choice = 0;
      for (std::uint32_t k = 0; k < labels_[node].size(); ++k) {
        std::int64_t value = unary_[node][k];
        for (const std::uint32_t f : used)
          value = std::min(kInfeasible, value + lookup(all_factors_[f], node, k, scope, digits));
        if (value < least) {
          least = value;
          choice = static_cast<std::uint8_t>(k);
        }
      }
      message.values.push_back(least);
      bucket.choice.push_back(choice);
      is_last = !advance(scope, digits);
    }
    for (const std::uint32_t f : used) {
      is_used_[f] = 1;
      std::vector<std::int64_t>().swap(all_factors_[f].values);
    }
    detach(node, scope);
    buckets_.push_back(std::move(bucket));
    if (scope.empty()) return message.values.front();
    add_factor(std::move(message));
    return 0;
  }

  /// Next assignment of the scope; false after the last.
  bool advance(const std::vector<std::uint32_t>& scope, std::vector<std::uint32_t>& digits) const {
    for (std::size_t i = 0; i < scope.size(); ++i) {
      if (++digits[i] < labels_[scope[i]].size()) return true;
      digits[i] = 0;
    }
    return false;
  }

  std::int64_t lookup(const Factor& f, std::uint32_t node, std::uint32_t label,
                      const std::vector<std::uint32_t>& scope,
                      const std::vector<std::uint32_t>& digits) const {
    std::size_t index = 0, stride = 1;
    for (const std::uint32_t u : f.scope) {
      const std::uint32_t digit =
          u == node ? label
                    : digits[static_cast<std::size_t>(
                          std::lower_bound(scope.begin(), scope.end(), u) - scope.begin())];
      index += stride * digit;
      stride *= labels_[u].size();
    }
    return f.values[index];
  }

  /// Takes the node out of the graph and joins its neighbours pairwise.
  void detach(std::uint32_t node, const std::vector<std::uint32_t>& scope) {
    for (const std::uint32_t u : scope) {
      std::vector<std::uint32_t> merged;
      std::set_union(neighbours_[u].begin(), neighbours_[u].end(), scope.begin(), scope.end(),
                     std::back_inserter(merged));
      std::erase_if(merged, [&](std::uint32_t v) { return v == u || v == node; });
      neighbours_[u] = std::move(merged);
    }
  }

  Labelling read_back(std::int64_t total) const {
    std::vector<std::uint32_t> chosen(graph_.num_nodes(), 0);
    for (auto b = buckets_.rbegin(); b != buckets_.rend(); ++b) {
      std::size_t index = 0, stride = 1;
      for (const std::uint32_t u : b->scope) {
        index += stride * chosen[u];
        stride *= labels_[u].size();
      }
      chosen[b->node] = b->choice[index];
    }
    Labelling out;
    out.cost = total;
    for (std::uint32_t u = 0; u < graph_.num_nodes(); ++u)
      out.labels.push_back(labels_[u][chosen[u]]);
    return out;
  }

  const LabelGraph& graph_;
  std::size_t max_entries_;
  std::vector<std::vector<std::uint8_t>> labels_;  ///< allowed labels per node
  std::vector<std::vector<std::int64_t>> unary_;
  std::vector<std::vector<std::uint32_t>> neighbours_;  ///< sorted, of the remaining graph
  std::vector<std::vector<std::uint32_t>> factors_;     ///< per node: factors that mention it
  std::vector<Factor> all_factors_;
  std::vector<char> is_used_;
  std::vector<Bucket> buckets_;
};

}  // namespace

std::vector<PrunedLabel> prune_labels(LabelGraph& graph) {
  std::vector<PrunedLabel> pruned;
  std::vector<std::uint32_t> queue(graph.num_nodes());
  std::vector<char> is_queued(graph.num_nodes(), 1);
  for (std::uint32_t u = 0; u < graph.num_nodes(); ++u) queue[u] = u;
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

std::optional<Labelling> solve_by_elimination(const LabelGraph& graph, std::size_t table_entries) {
  // Choosing the next node is quadratic: leave very large groups to the search.
  if (graph.num_nodes() > 3'000) return std::nullopt;
  return Elimination(graph, table_entries).solve();
}

}  // namespace hexwright
