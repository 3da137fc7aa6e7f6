// Partners of all nodes are listed with the axis that cuts them and sorted; a cell that appears
// with two axes is crossed. Sorting instead of hashing keeps the order, and so the result, fixed.
#include "dual/domain/crossed_cells.h"

#include <algorithm>

namespace hexwright::dual {

namespace {

struct Crossing {
  LatticeCoord cell;
  int axis;
  friend auto operator<=>(const Crossing&, const Crossing&) = default;
};

// The cell that shares a node's pillow of this axis: across the node's core face.
LatticeCoord partner_of(LatticeCoord node, int axis, int parity) {
  const bool is_core_low = (node[axis] & 1) == (parity >> axis & 1);
  node[axis] += is_core_low ? -1 : 1;
  return node;
}

// `above` is the depth above: a partner whose parent is not split is a coarser leaf, which is
// capped whole and cannot be split at this depth.
std::vector<Crossing> collect_crossings(const SplitNodes& nodes, const SplitNodes* above, int depth,
                                        const Domain& domain) {
  std::vector<Crossing> crossings;
  for (const NodeGroup& group : nodes.groups())
    for (int bit = 0; bit < 8; ++bit) {
      if (!(group.children >> bit & 1)) continue;
      LatticeCoord node;
      for (int a = 0; a < 3; ++a) node[a] = 2 * group.parent[a] + (bit >> a & 1);
      for (int axis = 0; axis < 3; ++axis) {
        const LatticeCoord cell = partner_of(node, axis, group.parity);
        if (nodes.contains(cell) || !domain.contains_node(cell, depth)) continue;
        if (!above || above->contains(parent_of(cell))) crossings.push_back({cell, axis});
      }
    }
  std::sort(crossings.begin(), crossings.end());
  return crossings;
}

}  // namespace

// A cell cut along two axes would get caps of both in one place: splitting it costs less in quality
// and hardly more hexes. Sorted by cell, so crossings of one cell follow each other.
std::size_t split_crossed_cells(SplitNodes& nodes, const SplitNodes* above, int depth,
                                const Domain& domain) {
  const auto crossings = collect_crossings(nodes, above, depth, domain);
  std::size_t num_split = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    const Crossing &a = crossings[i], &b = crossings[i + 1];
    if (a.cell != b.cell || a.axis == b.axis || nodes.contains(a.cell)) continue;
    nodes.insert(a.cell);
    ++num_split;
  }
  return num_split;
}

}  // namespace hexwright::dual
