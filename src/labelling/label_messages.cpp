// A lower bound on labellings by passing messages along the conflicts.
//
// Based on: Kolmogorov, "Convergent tree-reweighted message passing for energy minimization", IEEE
// TPAMI 28(10), 2006: sequential passes, each node handing on what it gathered in equal parts.
// Differs: whole numbers throughout; pairs are hard exclusions, so an edge needs two rows of eight
// costs and no table. Each row is one vector register of 16-bit numbers, for which the loops over
// eight labels below are written.
#include "labelling/label_messages.h"

#include <algorithm>
#include <numeric>

namespace hexwright::labelling {
namespace {

// Costs of single nodes are cut at kCap, so that shares stay within +-2 kCap and an excluded pair,
// kExcluded, is told from a dear one.
constexpr std::int32_t kCap = 4095;
constexpr std::int16_t kExcluded = 16383, kLeastExcluded = 12000;

constexpr std::uint32_t kMaxDegree = 1 << 15;

using Row = std::array<std::int16_t, kNumParities>;

/// kExcluded where the mask has a bit.
using ExpandedMasks = std::array<Row, 256>;
constexpr ExpandedMasks make_expanded_masks() {
  ExpandedMasks rows{};
  for (std::size_t mask = 0; mask < rows.size(); ++mask)
    for (std::size_t p = 0; p < kNumParities; ++p)
      rows[mask][p] = mask >> p & 1 ? kExcluded : std::int16_t{0};
  return rows;
}
constexpr ExpandedMasks kExpandedMasks = make_expanded_masks();

}  // namespace

LabelMessages::LabelMessages(const LabelGraph& graph) : allowed_(graph.allowed) {
  first_edge_.push_back(0);
  for (const auto& edges : graph.edges) {
    for (const LabelEdge& e : edges) {
      HalfEdge half{e.other, 0, {}, {}};
      for (std::size_t q = 0; q < kNumParities; ++q)
        for (std::size_t p = 0; p < kNumParities; ++p)
          if (e.forbids[p] >> q & 1)
            half.excluded_by[q] = static_cast<LabelMask>(half.excluded_by[q] | 1 << p);
      edges_.push_back(half);
    }
    first_edge_.push_back(static_cast<std::uint32_t>(edges_.size()));
  }
  num_lower_.assign(graph.num_nodes(), 0);
  link_twins();
  scale_costs(graph);
  least_total_.resize(costs_.size());
  for (auto& row : least_total_) row.fill(0);
}

void LabelMessages::link_twins() {
  // A node's half-edges are sorted by the other node, so going through all nodes in order meets the
  // twins of each node's half-edges in order, too.
  std::vector<std::uint32_t> next(first_edge_.begin(), first_edge_.end() - 1);
  for (std::uint32_t u = 0; u < num_lower_.size(); ++u)
    for (std::uint32_t h = first_edge_[u]; h < first_edge_[u + 1]; ++h) {
      edges_[h].twin = next[edges_[h].other]++;
      num_lower_[u] += edges_[h].other < u;
    }
  // What a node gathers must fit its type: with more neighbours only the plain bound is given.
  for (std::uint32_t u = 0; u < num_lower_.size(); ++u)
    is_saturated_ = is_saturated_ || first_edge_[u + 1] - first_edge_[u] > kMaxDegree;
}

void LabelMessages::scale_costs(const LabelGraph& graph) {
  step_ = 0;
  for (std::size_t u = 0; u < graph.num_nodes(); ++u) {
    const std::int64_t least = graph.least_cost(u) / kLeafCost;
    base_ += least;
    Totals row{};
    for (Parity p = 0; p < kNumParities; ++p) {
      if (!(graph.allowed[u] >> p & 1)) continue;
      const std::int64_t excess = graph.costs[u][p] / kLeafCost - least;
      step_ = std::gcd(step_, excess);
      row[p] = static_cast<std::int32_t>(std::min<std::int64_t>(kCap, excess * kUnit));
    }
    costs_.push_back(row);
  }
  step_ = std::max<std::int64_t>(1, step_);
}

std::int64_t LabelMessages::bound() const {
  const std::int64_t step = step_ * kUnit;
  return base_ + (bound_ + step - 1) / step * step_;
}

void LabelMessages::drop_labels_from(std::int64_t leaves) {
  // The dearest labelling that still counts as cheaper.
  const std::int64_t limit = (leaves - 1 - base_) / step_ * step_ * kUnit;
  for (std::size_t u = 0; u < costs_.size(); ++u)
    for (Parity p = 0; p < kNumParities; ++p)
      if (least_total_[u][p] > limit) allowed_[u] = static_cast<LabelMask>(allowed_[u] & ~(1 << p));
}

bool LabelMessages::pass(bool is_forward) {
  const auto count = static_cast<std::uint32_t>(costs_.size());
  for (std::uint32_t i = 0; i < count && !is_saturated_; ++i)
    if (!visit(is_forward ? i : count - 1 - i, is_forward)) return false;
  return true;
}

/// Draws the least cost of each own label out of an edge into the node. `dearest` tells afterwards
/// which labels an edge excludes whatever the other node takes.
void LabelMessages::pull(HalfEdge& edge, Totals& cost, Row& dearest) {
  const Row& theirs = edges_[edge.twin].share;
  Row mine = edge.share, least;
  least.fill(kExcluded);
  for (unsigned rest = allowed_[edge.other]; rest != 0; rest &= rest - 1) {
    const auto q = static_cast<std::size_t>(std::countr_zero(rest));
    const Row& excluded = kExpandedMasks[edge.excluded_by[q]];
    const std::int16_t share = theirs[q];
    for (std::size_t p = 0; p < kNumParities; ++p)
      least[p] = std::min(least[p], static_cast<std::int16_t>(excluded[p] + share));
  }
  for (std::size_t p = 0; p < kNumParities; ++p) {
    dearest[p] = std::max(dearest[p], least[p]);
    mine[p] = static_cast<std::int16_t>(mine[p] + least[p]);
  }
  for (std::size_t p = 0; p < kNumParities; ++p) {
    cost[p] += mine[p];
    least[p] = static_cast<std::int16_t>(-least[p]);
  }
  edge.share = least;
}

/// Adds to an edge's own shares. The least of them then goes to the other side, which keeps both
/// small; pairs cost the same. Leaves the edge alone when a share would look like an exclusion.
void LabelMessages::push(HalfEdge& edge, const Row& part, const Row& dropped) {
  Row mine = edge.share, theirs = edges_[edge.twin].share;
  std::int16_t lowest = kExcluded, largest = 0;
  for (std::size_t p = 0; p < kNumParities; ++p) {
    mine[p] = static_cast<std::int16_t>(mine[p] + part[p]);
    const bool is_dropped = dropped[p] != 0;
    lowest = std::min(lowest, is_dropped ? kExcluded : mine[p]);
    largest = std::max(largest, is_dropped ? std::int16_t{0} : mine[p]);
  }
  if (largest - lowest >= kLeastExcluded) {
    is_saturated_ = true;
    return;
  }
  for (std::size_t p = 0; p < kNumParities; ++p) {
    mine[p] = dropped[p] ? kExcluded : static_cast<std::int16_t>(mine[p] - lowest);
    theirs[p] = static_cast<std::int16_t>(theirs[p] +
                                          (theirs[p] < kLeastExcluded ? lowest : std::int16_t{0}));
  }
  edge.share = mine;
  edges_[edge.twin].share = theirs;
}

/// Moves the least cost at a node into the bound and takes off what each edge ahead gets of the
/// rest, in equal parts.
LabelMessages::Row LabelMessages::settle(std::uint32_t node, std::int32_t num_parts,
                                         std::int32_t num_ahead) {
  Totals& cost = costs_[node];
  std::int32_t least = std::numeric_limits<std::int32_t>::max();
  for (std::size_t p = 0; p < kNumParities; ++p)
    if (allowed_[node] >> p & 1) least = std::min(least, cost[p]);
  bound_ += least;
  Row part{};
  for (std::size_t p = 0; p < kNumParities; ++p) {
    if (!(allowed_[node] >> p & 1)) {
      cost[p] = 0;  // or it would grow with every visit
      continue;
    }
    cost[p] -= least;
    least_total_[node][p] = std::max(least_total_[node][p], bound_ + cost[p]);
    cost[p] = std::min(cost[p], kCap);
    part[p] = static_cast<std::int16_t>(cost[p] / num_parts);
    cost[p] -= part[p] * num_ahead;
  }
  return part;
}

/// Gathers everything at a node and hands it on to the edges ahead. Nothing can be gathered from
/// those: what they held was drawn out by the pass before, which ran the other way.
bool LabelMessages::visit(std::uint32_t node, bool is_forward) {
  // Half-edges are sorted by the other node: those to lower nodes come first.
  const auto begin = edges_.begin() + first_edge_[node];
  const auto middle = begin + num_lower_[node];
  const auto end = edges_.begin() + first_edge_[node + 1];
  Row dearest{};
  const auto gather = [&](auto from, auto to) {
    for (auto e = from; e != to; ++e) pull(*e, costs_[node], dearest);
  };
  is_forward ? gather(begin, middle) : gather(middle, end);
  for (std::size_t p = 0; p < kNumParities; ++p)
    if (dearest[p] >= kLeastExcluded)
      allowed_[node] = static_cast<LabelMask>(allowed_[node] & ~(1 << p));
  if (allowed_[node] == 0) return false;

  const auto num_lower = static_cast<std::int32_t>(middle - begin);
  const auto num_higher = static_cast<std::int32_t>(end - middle);
  const Row part =
      settle(node, std::max({1, num_lower, num_higher}), is_forward ? num_higher : num_lower);
  const Row& dropped = kExpandedMasks[static_cast<LabelMask>(~allowed_[node])];
  const auto hand_on = [&](auto from, auto to) {
    for (auto e = from; e != to; ++e) push(*e, part, dropped);
  };
  is_forward ? hand_on(middle, end) : hand_on(begin, middle);
  return true;
}

}  // namespace hexwright::labelling
