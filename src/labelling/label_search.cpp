// Branch and bound for groups of clusters whose elimination tables would be too large.
//
// Clusters are labelled one after the other, neighbours soon after each other so that conflicts
// show early, cheapest label first. The bound adds what the clusters still to come cost at least,
// each by itself; it ignores their conflicts, so it is weak, which is why this is the last method
// asked. Based on: Land, Doig, "An automatic method of solving discrete programming problems",
// Econometrica 28, 1960.
#include <algorithm>
#include <numeric>

#include "hexwright/base/cancel.h"

#include "labelling/label_graph.h"

namespace hexwright::labelling {
namespace {

class BranchAndBound {
 public:
  BranchAndBound(const LabelGraph& graph, const Labelling& start, std::size_t max_nodes)
      : graph_(graph),
        max_nodes_(max_nodes),
        order_(breadth_first_order()),
        rest_bound_(order_.size() + 1, 0),
        labels_(graph.num_nodes(), 0),
        blocked_(graph.num_nodes()),
        best_(start) {
    for (std::size_t i = order_.size(); i-- > 0;)
      rest_bound_[i] = rest_bound_[i + 1] + graph_.least_cost(order_[i]);
    for (auto& counts : blocked_) counts.fill(0);
  }

  /// Past the node limit the bound at the root is all that is known.
  SearchResult run() {
    descend();
    SearchResult out;
    out.is_optimal = num_nodes_ < max_nodes_;
    out.lower_bound = out.is_optimal ? best_.cost : rest_bound_[0];
    out.best = std::move(best_);
    return out;
  }

 private:
  /// Neighbours close to each other, so that a label soon meets the labels it excludes.
  std::vector<std::uint32_t> breadth_first_order() const {
    std::vector<std::uint32_t> order;
    std::vector<char> is_seen(graph_.num_nodes(), 0);
    for (std::uint32_t start = 0; start < graph_.num_nodes(); ++start) {
      if (is_seen[start]) continue;
      is_seen[start] = 1;
      order.push_back(start);
      for (std::size_t i = order.size() - 1; i < order.size(); ++i)
        for (const LabelEdge& e : graph_.edges[order[i]])
          if (!is_seen[e.other]) {
            is_seen[e.other] = 1;
            order.push_back(e.other);
          }
    }
    return order;
  }

  /// One depth of the search: the node's labels in order of cost and how far we got.
  struct Frame {
    std::array<std::uint8_t, kNumParities> labels{};
    int num_labels = 0, next = 0;
    std::int64_t cost_before = 0;
    bool is_set = false;
  };

  /// The labels that no neighbour set so far excludes. Stable: equal costs keep the labels' order,
  /// so the result does not depend on the sort.
  Frame open(std::uint32_t node, std::int64_t cost) const {
    Frame f;
    f.cost_before = cost;
    for (Parity p = 0; p < kNumParities; ++p)
      if ((graph_.allowed[node] >> p & 1) && blocked_[node][p] == 0)
        f.labels[f.num_labels++] = static_cast<std::uint8_t>(p);
    std::stable_sort(f.labels.begin(), f.labels.begin() + f.num_labels,
                     [&](auto a, auto b) { return graph_.costs[node][a] < graph_.costs[node][b]; });
    return f;
  }

  /// Counts, not marks: several neighbours may exclude one label, and each takes back its own.
  void block(std::uint32_t node, Parity label, int sign) {
    for (const LabelEdge& e : graph_.edges[node])
      for (Parity q = 0; q < kNumParities; ++q)
        if (e.forbids[label] >> q & 1) blocked_[e.other][q] += sign;
  }

  /// Depth-first without recursion: groups can be thousands of clusters deep.
  void descend() {
    std::vector<Frame> stack = {open(order_[0], 0)};
    CancelCheck check_cancelled;
    while (!stack.empty() && num_nodes_ < max_nodes_) {
      check_cancelled();
      Frame& f = stack.back();
      const std::size_t depth = stack.size() - 1;
      const std::uint32_t node = order_[depth];
      if (f.is_set) {
        block(node, labels_[node], -1);
        f.is_set = false;
      }
      if (f.next == f.num_labels) {
        stack.pop_back();
        continue;
      }
      const Parity label = f.labels[f.next++];
      const std::int64_t cost = f.cost_before + graph_.costs[node][label];
      if (cost + rest_bound_[depth + 1] >= best_.cost) {
        f.next = f.num_labels;  // later labels cost at least as much
        continue;
      }
      ++num_nodes_;
      labels_[node] = static_cast<std::uint8_t>(label);
      if (depth + 1 == order_.size()) {
        best_ = {labels_, cost};
        continue;
      }
      block(node, label, +1);
      f.is_set = true;
      stack.push_back(open(order_[depth + 1], cost));
    }
  }

  const LabelGraph& graph_;
  std::size_t max_nodes_, num_nodes_ = 0;
  std::vector<std::uint32_t> order_;
  std::vector<std::int64_t> rest_bound_;  ///< least cost of order_[i..]
  std::vector<std::uint8_t> labels_;
  std::vector<std::array<int, kNumParities>> blocked_;  ///< set neighbours that exclude a label
  Labelling best_;
};

/// Whether a node may take a label while all others keep theirs.
bool is_free(const LabelGraph& graph, const Labelling& at, std::size_t node, Parity label) {
  for (const LabelEdge& e : graph.edges[node])
    if (e.forbids[label] >> at.labels[e.other] & 1) return false;
  return true;
}

}  // namespace

Labelling make_start(const LabelGraph& graph) {
  LabelCosts totals{};
  for (const LabelCosts& c : graph.costs)
    for (Parity p = 0; p < kNumParities; ++p) totals[p] += c[p];
  const auto uniform = std::min_element(totals.begin(), totals.end()) - totals.begin();
  // Equal labels never exclude each other, so one label for all is always feasible.
  Labelling out;
  out.labels.assign(graph.num_nodes(), static_cast<std::uint8_t>(uniform));
  out.cost = totals[static_cast<std::size_t>(uniform)];
  // Every change lowers the cost by at least one, so this ends.
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (std::size_t u = 0; u < graph.num_nodes(); ++u)
      for (Parity p = 0; p < kNumParities; ++p) {
        const std::int64_t gain = graph.costs[u][out.labels[u]] - graph.costs[u][p];
        if (gain <= 0 || !is_free(graph, out, u, p)) continue;
        out.labels[u] = static_cast<std::uint8_t>(p);
        out.cost -= gain;
        is_changed = true;
      }
  }
  return out;
}

SearchResult solve_by_search(const LabelGraph& graph, const Labelling& start,
                             std::size_t max_nodes) {
  return BranchAndBound(graph, start, max_nodes).run();
}

}  // namespace hexwright::labelling
