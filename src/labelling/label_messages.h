// A lower bound on labellings by passing messages along the conflicts, and what it says of labels.
#pragma once

#include "labelling/label_graph.h"

namespace hexwright::labelling {

/// Moves costs between nodes and edges without changing any labelling's total, so that as much as
/// possible ends in a constant: the bound. What a label then still costs above its node's cheapest
/// proves that labellings with it cost at least that much more.
///
/// All in whole numbers, so bounds are exact and the same on every machine. Costs far above a
/// node's least are cut, which can only weaken the bound. Tie-breaks (LabelGraph) are not looked
/// at.
class LabelMessages {
 public:
  /// Edges sorted by the other node, as make_graph() and subgraph() leave them.
  explicit LabelMessages(const LabelGraph& graph);

  /// Lower bound on every labelling that keeps to the remaining labels, in leaves; rounded up to
  /// what sums of the graph's costs can be.
  std::int64_t bound() const;
  /// The bound's distance from the best that the node's labels allow, in units of a leaf / kUnit:
  /// how much more than bound() a labelling with this label costs at least.
  std::int64_t excess(std::size_t node, Parity p) const {
    return least_total_[node][static_cast<std::size_t>(p)] - bound_;
  }
  /// Labels that may still be in the best labelling.
  LabelMask allowed(std::size_t node) const { return allowed_[node]; }
  std::size_t num_half_edges() const { return edges_.size(); }

  /// Once over all nodes, forwards or backwards. The bound never falls. False when no labelling is
  /// left.
  bool pass(bool is_forward);

  /// Forgets the labels that no labelling of fewer leaves has; the bound then holds for those
  /// alone.
  void drop_labels_from(std::int64_t leaves);

  static constexpr int kUnit = 32;

 private:
  using Row = std::array<std::int16_t, kNumParities>;
  /// One direction of an edge. A pair of labels (p, q) that is not excluded costs this side's share
  /// of p plus the twin's share of q.
  struct HalfEdge {
    std::uint32_t other = 0, twin = 0;
    std::array<LabelMask, kNumParities> excluded_by{};  ///< own labels that the other's q excludes
    Row share{};
  };
  using Totals = std::array<std::int32_t, kNumParities>;

  void link_twins();
  void scale_costs(const LabelGraph& graph);
  void pull(HalfEdge& edge, Totals& cost, Row& dearest);
  void push(HalfEdge& edge, const Row& part, const Row& dropped);
  Row settle(std::uint32_t node, std::int32_t num_parts, std::int32_t num_ahead);
  bool visit(std::uint32_t node, bool is_forward);

  std::vector<Totals> costs_;  ///< what is left at the nodes
  std::vector<LabelMask> allowed_;
  std::vector<std::uint32_t> first_edge_;
  std::vector<std::uint32_t> num_lower_;  ///< per node: half-edges to lower nodes
  std::vector<HalfEdge> edges_;
  std::vector<std::array<std::int64_t, kNumParities>> least_total_;
  bool is_saturated_ = false;  ///< a share has grown too large for its type; passes do nothing more
  std::int64_t base_ = 0;      ///< sum of the nodes' least costs, in leaves
  std::int64_t step_ = 1;      ///< every labelling costs base_ plus a multiple of this
  std::int64_t bound_ = 0;     ///< above base_, in units
};

}  // namespace hexwright::labelling
