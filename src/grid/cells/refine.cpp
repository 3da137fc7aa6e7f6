// Builds an adaptive grid from a size function.
//
// Subtrees are tasks: each is split depth first into a list of its own, which keeps the order of
// leaves, and the lists are joined.
#include "hexwright/grid/refine.h"

#include <algorithm>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"

#include "grid/cells/prefault.h"

namespace hexwright {

using namespace grids;

namespace {

/// A cell on its own level's lattice.
struct Node {
  LatticeCoord index = {0, 0, 0};
  int level = 0;

  Node child(int q) const {
    return {{2 * index[0] + (q & 1), 2 * index[1] + (q >> 1 & 1), 2 * index[2] + (q >> 2)},
            level + 1};
  }
};

class Refiner {
 public:
  Refiner(const GridFrame& frame, int max_level, SplitTest should_split)
      : max_level_(max_level), should_split_(should_split) {
    lattice_.frame = frame;
    lattice_.finest_level = max_level;
  }

  bool is_split(const Node& node) const {
    if (node.level >= max_level_) return false;
    LatticeCoord low, high;
    for (int a = 0; a < 3; ++a) {
      low[a] = node.index[a] * (1 << (max_level_ - node.level));
      high[a] = (node.index[a] + 1) * (1 << (max_level_ - node.level));
    }
    return should_split_({lattice_to_world(lattice_, low), lattice_to_world(lattice_, high)},
                         node.level);
  }

  void collect_leaves(const Node& node, std::vector<Node>& leaves) const {
    if (!is_split(node)) {
      leaves.push_back(node);
      return;
    }
    for (int q = 0; q < 8; ++q) collect_leaves(node.child(q), leaves);
  }

 private:
  Grid lattice_;  ///< no cells: says where the finest lattice lies
  int max_level_;
  SplitTest should_split_;
};

/// Roots of subtrees in the order of leaves, opened until there are enough; leaves among them are
/// marked so that they are not tested twice.
struct Subtree {
  Node node;
  bool is_leaf = false;
};

std::vector<Subtree> make_subtrees(const Refiner& refiner, const std::vector<LatticeCoord>& roots) {
  constexpr std::size_t kMinTasks = 256;
  std::vector<Subtree> tasks;
  for (const LatticeCoord& root : roots) tasks.push_back({{root, 0}, false});
  for (int round = 0; round < 4 && tasks.size() < kMinTasks; ++round) {
    std::vector<Subtree> finer;
    for (const Subtree& t : tasks) {
      if (t.is_leaf || !refiner.is_split(t.node)) {
        finer.push_back({t.node, true});
        continue;
      }
      for (int q = 0; q < 8; ++q) finer.push_back({t.node.child(q), false});
    }
    tasks = std::move(finer);
  }
  return tasks;
}

/// Leaves are kept on their own level's lattice until the deepest level that occurs is known.
void join_leaves(const std::vector<std::vector<Node>>& lists, Grid& out) {
  std::vector<std::size_t> first = {0};
  for (const auto& list : lists) {
    first.push_back(first.back() + list.size());
    for (const Node& node : list) out.finest_level = std::max(out.finest_level, node.level);
  }
  out.cells.reserve(first.back());
  prefault_pages(out.cells.raw().data(), first.back() * sizeof(GridCell));
  out.cells.resize(first.back());
  parallel_for(
      lists.size(),
      [&](std::size_t i) {
        GridCell* cell = out.cells.raw().data() + first[i];
        for (const Node& node : lists[i]) {
          for (int a = 0; a < 3; ++a)
            cell->corner[a] = node.index[a] * (1 << (out.finest_level - node.level));
          cell->level = static_cast<std::int8_t>(node.level);
          ++cell;
        }
      },
      1);
}

}  // namespace

Grid refine_where(const GridFrame& frame, std::vector<LatticeCoord> roots, int max_level,
                  SplitTest should_split) {
  if (max_level < 0 || max_level > kMaxGridLevel)
    throw Error(ErrorCode::BadArgument,
                fmt::format("refine_where: the deepest level must be within 0..{}", kMaxGridLevel));
  const Refiner refiner(frame, max_level, should_split);
  const std::vector<Subtree> tasks = make_subtrees(refiner, roots);
  std::vector<std::vector<Node>> lists(tasks.size());
  parallel_for(
      tasks.size(),
      [&](std::size_t i) {
        if (tasks[i].is_leaf)
          lists[i].push_back(tasks[i].node);
        else
          refiner.collect_leaves(tasks[i].node, lists[i]);
      },
      1);
  Grid out;
  out.frame = frame;
  out.roots = std::move(roots);
  join_leaves(lists, out);
  if (const auto issue = out.find_problem())
    throw Error(ErrorCode::BadArgument, "refine_where: " + issue->message);
  return out;
}

}  // namespace hexwright
