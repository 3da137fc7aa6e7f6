// Exact labelling of a group by variable elimination.
//
// Nodes are removed one after the other, the one with the smallest joint table first; what a
// removed node costs at best becomes a table over its neighbours. Cost and memory are exponential
// in the width of that order alone, so groups that are long and thin are cheap whatever their size.
//
// Based on: Dechter, "Bucket elimination: a unifying framework for reasoning", Artificial
// Intelligence 113, 1999.
#include <algorithm>
#include <iterator>
#include <set>

#include "hexwright/base/cancel.h"

#include "labelling/label_graph.h"

namespace hexwright::labelling {
namespace {

// Groups that need more than this on average, and then a fixed amount, are left to other methods.
constexpr std::size_t kEntriesPerNode = 1024;

/// A cost table over a few nodes; the first node of the scope varies fastest.
struct Factor {
  std::vector<std::uint32_t> scope;
  std::vector<std::int64_t> values;
};

/// What elimination of a node leaves behind to read its label from its neighbours'.
struct Bucket {
  std::uint32_t node = 0;
  std::vector<std::uint32_t> scope;
  std::vector<std::uint8_t> choice;  ///< index into the node's labels, per entry of the scope
};

class Elimination {
 public:
  Elimination(const LabelGraph& graph, std::size_t max_entries)
      : graph_(graph),
        max_entries_(max_entries),
        labels_(graph.num_nodes()),
        neighbours_(graph.num_nodes()),
        factors_(graph.num_nodes()),
        size_(graph.num_nodes()) {
    for (std::uint32_t u = 0; u < graph.num_nodes(); ++u)
      for (Parity p = 0; p < kNumParities; ++p)
        if (graph.allowed[u] >> p & 1) labels_[u].push_back(static_cast<std::uint8_t>(p));
    for (std::uint32_t u = 0; u < graph.num_nodes(); ++u) {
      for (const LabelEdge& e : graph.edges[u]) neighbours_[u].push_back(e.other);
      std::sort(neighbours_[u].begin(), neighbours_[u].end());
    }
  }

  std::optional<Labelling> solve() {
    if (!plan()) return std::nullopt;
    for (std::uint32_t u = 0; u < graph_.num_nodes(); ++u)
      for (const LabelEdge& e : graph_.edges[u])
        if (u < e.other) add_edge_factor(u, e);
    std::int64_t total = 0;
    for (Bucket& bucket : buckets_) total = std::min(kInfeasibleCost, total + eliminate(bucket));
    return read_back(total);
  }

 private:
  /// Fixes the order and each node's neighbours at its turn, without any table. False when the
  /// tables would be too large: that is known cheaply, and before any work on them.
  bool plan() {
    for (std::uint32_t u = 0; u < graph_.num_nodes(); ++u) enqueue(u);
    const std::size_t max_work = 16 * max_entries_ + kEntriesPerNode * graph_.num_nodes();
    std::size_t work = 0;
    while (!queue_.empty()) {
      const auto [size, node] = *queue_.begin();
      work += size;
      if (size > max_entries_ || work > max_work) return false;
      queue_.erase(queue_.begin());
      buckets_.push_back({node, std::move(neighbours_[node]), {}});
      detach(node, buckets_.back().scope);
    }
    return true;
  }

  void add_edge_factor(std::uint32_t u, const LabelEdge& e) {
    Factor f{{u, e.other}, {}};
    for (const std::uint8_t q : labels_[e.other])
      for (const std::uint8_t p : labels_[u])
        f.values.push_back(e.forbids[p] >> q & 1 ? kInfeasibleCost : 0);
    add_factor(std::move(f));
  }

  void add_factor(Factor f) {
    const auto index = static_cast<std::uint32_t>(all_factors_.size());
    for (const std::uint32_t u : f.scope) factors_[u].push_back(index);
    all_factors_.push_back(std::move(f));
  }

  /// Puts a node into the queue by the size of the joint table of it and its neighbours, capped.
  void enqueue(std::uint32_t node) {
    std::size_t size = labels_[node].size();
    for (const std::uint32_t v : neighbours_[node]) {
      size *= labels_[v].size();
      if (size > max_entries_) {
        size = max_entries_ + 1;
        break;
      }
    }
    size_[node] = size;
    queue_.insert({size, node});
  }

  /// Adds a factor that mentions `node` to the joint table, whose fastest digit is the node's label
  /// and whose further digits are those of the node's neighbours in order.
  void add_to_joint(const Factor& f, std::uint32_t node, const std::vector<std::uint32_t>& scope,
                    std::vector<std::int64_t>& joint) const {
    std::vector<std::size_t> stride(scope.size(), 0);  // in the factor, per neighbour
    std::size_t own = 0, next = 1;
    for (const std::uint32_t u : f.scope) {
      if (u == node)
        own = next;
      else
        stride[static_cast<std::size_t>(std::lower_bound(scope.begin(), scope.end(), u) -
                                        scope.begin())] = next;
      next *= labels_[u].size();
    }
    const std::size_t num_own = labels_[node].size();
    std::vector<std::size_t> digits(scope.size(), 0);
    std::size_t base = 0;
    for (std::size_t at = 0; at < joint.size(); at += num_own) {
      for (std::size_t k = 0; k < num_own; ++k)
        joint[at + k] = std::min(kInfeasibleCost, joint[at + k] + f.values[base + k * own]);
      for (std::size_t i = 0; i < scope.size(); ++i) {
        base += stride[i];
        if (++digits[i] < labels_[scope[i]].size()) break;
        base -= stride[i] * digits[i];
        digits[i] = 0;
      }
    }
  }

  std::vector<std::int64_t> make_joint(std::uint32_t node,
                                       const std::vector<std::uint32_t>& scope) {
    std::size_t num_entries = 1;
    for (const std::uint32_t v : scope) num_entries *= labels_[v].size();
    const std::size_t num_own = labels_[node].size();
    std::vector<std::int64_t> joint(num_entries * num_own);
    for (std::size_t i = 0; i < joint.size(); ++i)
      joint[i] = graph_.costs[node][labels_[node][i % num_own]];
    for (const std::uint32_t f : factors_[node]) {
      if (all_factors_[f].values.empty()) continue;  // used up by another node
      add_to_joint(all_factors_[f], node, scope, joint);
      std::vector<std::int64_t>().swap(all_factors_[f].values);
    }
    return joint;
  }

  /// Minimises over a bucket's node; its cheapest completion becomes a factor over its neighbours.
  /// Returns the constant part when there are none.
  std::int64_t eliminate(Bucket& bucket) {
    check_cancelled();
    const std::vector<std::int64_t> joint = make_joint(bucket.node, bucket.scope);
    const std::size_t num_own = labels_[bucket.node].size();
    Factor message{bucket.scope, {}};
    for (std::size_t at = 0; at < joint.size(); at += num_own) {
      const auto first = joint.begin() + static_cast<std::ptrdiff_t>(at);
      const auto least = std::min_element(first, first + static_cast<std::ptrdiff_t>(num_own));
      message.values.push_back(*least);
      bucket.choice.push_back(static_cast<std::uint8_t>(least - first));
    }
    if (bucket.scope.empty()) return message.values.front();
    add_factor(std::move(message));
    return 0;
  }

  /// Takes the node out of the graph and joins its neighbours pairwise.
  void detach(std::uint32_t node, const std::vector<std::uint32_t>& scope) {
    for (const std::uint32_t u : scope) {
      std::vector<std::uint32_t> merged;
      std::set_union(neighbours_[u].begin(), neighbours_[u].end(), scope.begin(), scope.end(),
                     std::back_inserter(merged));
      std::erase_if(merged, [&](std::uint32_t v) { return v == u || v == node; });
      neighbours_[u] = std::move(merged);
      queue_.erase({size_[u], u});
      enqueue(u);
    }
  }

  Labelling read_back(std::int64_t total) const {
    Labelling out;
    out.cost = total;
    if (total >= kInfeasibleCost) return out;
    std::vector<std::size_t> chosen(graph_.num_nodes(), 0);
    for (auto b = buckets_.rbegin(); b != buckets_.rend(); ++b) {
      std::size_t index = 0, stride = 1;
      for (const std::uint32_t u : b->scope) {
        index += stride * chosen[u];
        stride *= labels_[u].size();
      }
      chosen[b->node] = b->choice[index];
    }
    for (std::uint32_t u = 0; u < graph_.num_nodes(); ++u)
      out.labels.push_back(labels_[u][chosen[u]]);
    return out;
  }

  const LabelGraph& graph_;
  std::size_t max_entries_;
  std::vector<std::vector<std::uint8_t>> labels_;       ///< allowed labels per node
  std::vector<std::vector<std::uint32_t>> neighbours_;  ///< sorted, of the remaining graph
  std::vector<std::vector<std::uint32_t>> factors_;     ///< per node: factors that mention it
  std::vector<std::size_t> size_;                       ///< per node: its key in the queue
  std::set<std::pair<std::size_t, std::uint32_t>> queue_;
  std::vector<Factor> all_factors_;  ///< without values once used
  std::vector<Bucket> buckets_;
};

}  // namespace

std::optional<Labelling> solve_by_elimination(const LabelGraph& graph, std::size_t table_entries) {
  if (std::find(graph.allowed.begin(), graph.allowed.end(), LabelMask{0}) != graph.allowed.end())
    return Labelling{{}, kInfeasibleCost};
  return Elimination(graph, table_entries).solve();
}

}  // namespace hexwright::labelling
