// The costs of both parities are summed per cluster, group by group and axis by axis: a node whose
// partner across the core face is not split costs one cell cut (or nothing, where the domain ends).
// Clusters never touch, so the cheaper parity of each is the optimum.
#include "dual/domain/core_planes.h"

#include <bit>

#include "base/disjoint_sets.h"

namespace hexwright::dual {

namespace {

// Clusters of groups whose nodes share at least a vertex.
class Clusters {
 public:
  explicit Clusters(const SplitNodes& nodes) : sets_(nodes.num_groups()) {
    for (std::size_t g = 0; g < nodes.num_groups(); ++g)
      for (int code = 14; code < 27; ++code)  // one of each pair of opposite offsets
        join_across(nodes, g, {code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1});
  }

  std::size_t root(std::size_t i) { return sets_.find(i); }

 private:
  // All children at a side of their parent touch its middle, and those at an edge the edge's
  // middle, so any two of them from both parents share a vertex.
  void join_across(const SplitNodes& nodes, std::size_t g, const std::array<int, 3>& offset) {
    const NodeGroup& group = nodes.groups()[g];
    int here = group.children, there = 0xFF;
    LatticeCoord parent = group.parent;
    for (int a = 0; a < 3; ++a) {
      parent[a] += offset[a];
      if (offset[a] == 0) continue;
      here &= kSideMask[a][offset[a] > 0];
      there &= kSideMask[a][offset[a] < 0];
    }
    if (!here) return;
    const std::int32_t other = nodes.find_group(parent);
    if (other < 0) return;
    const auto o = static_cast<std::size_t>(other);
    if (nodes.groups()[o].children & there) sets_.unite(g, o);
  }

  DisjointSets sets_;
};

// What a parity costs on one axis.
struct PlaneCost {
  std::size_t num_partners = 0;  // unsplit cells of the domain that the pillows run through
  std::size_t num_unpaired = 0;  // nodes whose other half is a partner or outside the domain
  friend auto operator<=>(const PlaneCost&, const PlaneCost&) = default;
  PlaneCost& operator+=(const PlaneCost& b) {
    num_partners += b.num_partners;
    num_unpaired += b.num_unpaired;
    return *this;
  }
};
struct AxisCost {
  std::array<PlaneCost, 2> of_parity;
  std::array<bool, 2> is_avoided = {false, false};  // leads a plane through a vertex to avoid

  // Ties go to the odd parity, whose planes run between siblings.
  int best_parity() const {
    if (is_avoided[0] != is_avoided[1]) return is_avoided[0];
    return !(of_parity[0] < of_parity[1]);
  }
};
using ClusterCost = std::array<AxisCost, 3>;

class PlaneChooser {
 public:
  PlaneChooser(SplitNodes& nodes, int depth, const Domain& domain)
      : nodes_(nodes), depth_(depth), domain_(domain) {}

  CorePlaneReport run(std::span<const LatticeCoord> avoid) {
    Clusters clusters(nodes_);
    std::vector<ClusterCost> costs(nodes_.num_groups());
    for (std::size_t g = 0; g < nodes_.num_groups(); ++g)
      add_costs(nodes_.groups()[g], costs[clusters.root(g)]);
    for (const LatticeCoord& vert : avoid) {
      LatticeCoord here, half_spaced;
      for (int a = 0; a < 3; ++a) {
        here[a] = vert[a] * (1 << depth_);
        half_spaced[a] = 2 * here[a];
      }
      // All nodes around a vertex are in one cluster.
      const std::int32_t g = nodes_.find_group_around(half_spaced);
      if (g < 0) continue;
      ClusterCost& cost = costs[clusters.root(static_cast<std::size_t>(g))];
      for (int a = 0; a < 3; ++a) cost[a].is_avoided[here[a] & 1] = true;
    }
    CorePlaneReport report;
    for (std::size_t g = 0; g < nodes_.num_groups(); ++g) {
      const ClusterCost& cost = costs[clusters.root(g)];
      std::uint8_t parity = 0;
      for (int a = 0; a < 3; ++a) {
        const int odd = cost[a].best_parity();
        parity |= static_cast<std::uint8_t>(odd << a);
        if (clusters.root(g) == g) report.num_partners += cost[a].of_parity[odd].num_partners;
      }
      nodes_.groups()[g].parity = parity;
    }
    return report;
  }

 private:
  void add_costs(const NodeGroup& group, ClusterCost& cost) const {
    for (int a = 0; a < 3; ++a) {
      cost[a].of_parity[1] += odd_cost(group, a);
      cost[a].of_parity[0] += even_cost(group, a, 0);
      cost[a].of_parity[0] += even_cost(group, a, 1);
    }
  }

  // Odd planes: each node is paired with its sibling.
  PlaneCost odd_cost(const NodeGroup& group, int axis) const {
    PlaneCost cost;
    for (int bit = 0; bit < 8; ++bit)
      if ((group.children >> bit & 1) && !(group.children >> (bit ^ 1 << axis) & 1))
        count(group, bit, axis, (bit >> axis & 1) ? -1 : 1, cost);
    return cost;
  }

  // Even planes: the nodes on one side are paired with those of the next group.
  PlaneCost even_cost(const NodeGroup& group, int axis, int side) const {
    PlaneCost cost;
    const int here = group.children & kSideMask[axis][side];
    if (!here) return cost;
    LatticeCoord next = group.parent;
    next[axis] += side ? 1 : -1;
    const std::int32_t found = nodes_.find_group(next);
    const int there = found < 0 ? 0 : nodes_.groups()[static_cast<std::size_t>(found)].children;
    for (int bit = 0; bit < 8; ++bit)
      if ((here >> bit & 1) && !(there >> (bit ^ 1 << axis) & 1))
        count(group, bit, axis, side ? 1 : -1, cost);
    return cost;
  }

  // A node without split partner in direction `step`.
  void count(const NodeGroup& group, int bit, int axis, int step, PlaneCost& cost) const {
    LatticeCoord cell;
    for (int a = 0; a < 3; ++a) cell[a] = 2 * group.parent[a] + (bit >> a & 1);
    cell[axis] += step;
    ++cost.num_unpaired;
    cost.num_partners += domain_.contains_node(cell, depth_);
  }

  SplitNodes& nodes_;
  int depth_;
  const Domain& domain_;
};

}  // namespace

CorePlaneReport choose_core_planes(SplitNodes& nodes, int depth, const Domain& domain,
                                   std::span<const LatticeCoord> avoid) {
  return PlaneChooser(nodes, depth, domain).run(avoid);
}

}  // namespace hexwright::dual
