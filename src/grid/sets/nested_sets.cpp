// From leaves to split nodes and back.
//
// Leaves in Morton order meet their ancestors in Morton order too, so each depth's bricks fill one
// after the other; the way back walks every depth with one cursor.
#include "grid/sets/nested_sets.h"

#include <algorithm>

#include "hexwright/base/parallel.h"

#include "grid/cells/prefault.h"

namespace hexwright::grids {
namespace {

constexpr std::size_t kLeavesPerChunk = 1 << 15;

/// Fills the bricks of every depth from consecutive leaves.
class AncestorStream {
 public:
  AncestorStream(const Grid& grid, const LatticeDomain& domain)
      : finest_level_(grid.finest_level),
        last_(grid.finest_level, LatticeCoord{-1, -1, -1}),
        bricks_(grid.finest_level) {
    for (int a = 0; a < 3; ++a) shift_[a] = domain.shift()[a] * (1 << grid.finest_level);
  }

  void add(const GridCell& leaf) {
    for (int depth = leaf.level - 1; depth >= 0; --depth) {
      LatticeCoord node;
      for (int a = 0; a < 3; ++a) node[a] = (leaf.corner[a] + shift_[a]) >> (finest_level_ - depth);
      if (is_same_coord(node, last_[depth])) return;
      last_[depth] = node;
      const BrickKey key = brick_of_node(node);
      auto& bricks = bricks_[depth];
      if (bricks.empty() || bricks.back().key != key) bricks.push_back({key, 0});
      bricks.back().bits |= BrickBits{1} << bit_of_node(node);
    }
  }

  std::vector<Brick>& bricks(int depth) { return bricks_[depth]; }

 private:
  int finest_level_;
  LatticeCoord shift_;
  std::vector<LatticeCoord> last_;  ///< per depth: the ancestor met last
  std::vector<std::vector<Brick>> bricks_;
};

/// A subtree of the output, written by one task.
struct Subtree {
  LatticeCoord node;
  int depth = 0;
  std::size_t first_leaf = 0;
};

/// Writes the leaves of subtrees.
class LeafWriter {
 public:
  LeafWriter(const NestedSets& sets, const LatticeDomain& domain, Grid& out)
      : sets_(sets), domain_(domain), out_(out) {}

  std::size_t count(const LatticeCoord& node, int depth) const {
    std::size_t num_splits = 0;
    if (!is_split(node, depth)) return 1;
    for (int d = depth; d < static_cast<int>(sets_.size()); ++d)
      num_splits += count_below(node, depth, d);
    return 1 + 7 * num_splits;
  }

  bool is_split(const LatticeCoord& node, int depth) const {
    return depth < static_cast<int>(sets_.size()) && sets_[depth].contains(node);
  }

  /// Writes the node's leaves from position `at` on and returns the position after them.
  std::size_t write(const LatticeCoord& node, int depth, std::size_t at) const {
    if (!is_split(node, depth)) {
      write_leaf(node, depth, at);
      return at + 1;
    }
    return write_children(node, depth, at);
  }

 private:
  std::size_t write_children(const LatticeCoord& node, int depth, std::size_t at) const {
    const LatticeCoord first = {2 * node[0], 2 * node[1], 2 * node[2]};
    const bool may_split = depth + 1 < static_cast<int>(sets_.size());
    // All eight children lie in one brick.
    const BrickBits word = may_split ? sets_[depth + 1].bits(brick_of_node(first)) : 0;
    const unsigned octet = word ? child_octet(word, bit_of_node(node)) : 0;
    for (int q = 0; q < 8; ++q) {
      const LatticeCoord child = {first[0] + (q & 1), first[1] + (q >> 1 & 1), first[2] + (q >> 2)};
      if (octet >> q & 1)
        at = write_children(child, depth + 1, at);
      else
        write_leaf(child, depth + 1, at++);
    }
    return at;
  }

  void write_leaf(const LatticeCoord& node, int depth, std::size_t at) const {
    GridCell& cell = out_.cells.raw()[at];
    const int shift = out_.finest_level - depth;
    for (int a = 0; a < 3; ++a)
      cell.corner[a] = (node[a] - (domain_.shift()[a] << depth)) * (1 << shift);
    cell.level = static_cast<std::int8_t>(depth);
  }

  /// Number of nodes of set d below a node of a smaller or equal depth.
  std::size_t count_below(const LatticeCoord& node, int depth, int d) const {
    const int rise = d - depth;
    if (rise < 2) return count_few_below(node, rise, d);
    const int brick_rise = 3 * (rise - 2);
    const BrickKey first = morton_encode(node[0], node[1], node[2]) << brick_rise;
    const auto bricks = sets_[d].bricks();
    auto it = std::lower_bound(bricks.begin(), bricks.end(), first,
                               [](const Brick& b, BrickKey key) { return b.key < key; });
    std::size_t total = 0;
    for (; it != bricks.end() && it->key < first + (BrickKey{1} << brick_rise); ++it)
      total += static_cast<std::size_t>(count_bits(it->bits));
    return total;
  }

  std::size_t count_few_below(const LatticeCoord& node, int rise, int d) const {
    const int edge = 1 << rise;
    std::size_t total = 0;
    for (int q = 0; q < edge * edge * edge; ++q)
      total += sets_[d].contains({node[0] * edge + q % edge, node[1] * edge + q / edge % edge,
                                  node[2] * edge + q / edge / edge});
    return total;
  }

  const NestedSets& sets_;
  const LatticeDomain& domain_;
  Grid& out_;
};

/// Subtrees in the order of leaves: every root, opened until there are enough tasks.
std::vector<Subtree> make_subtrees(const LeafWriter& writer, const LatticeDomain& domain) {
  constexpr std::size_t kMinTasks = 128;
  std::vector<Subtree> tasks;
  for (const LatticeCoord& root : domain.shifted_roots()) tasks.push_back({root, 0, 0});
  for (int round = 0; round < 4 && tasks.size() < kMinTasks; ++round) {
    std::vector<Subtree> finer;
    for (const Subtree& t : tasks) {
      if (!writer.is_split(t.node, t.depth)) {
        finer.push_back(t);
        continue;
      }
      for (int q = 0; q < 8; ++q)
        finer.push_back(
            {{2 * t.node[0] + (q & 1), 2 * t.node[1] + (q >> 1 & 1), 2 * t.node[2] + (q >> 2)},
             t.depth + 1,
             0});
    }
    tasks = std::move(finer);
  }
  return tasks;
}

}  // namespace

// A chunk's first leaves repeat ancestors of the chunk before; the union forgets that.
NestedSets split_sets_of(const Grid& grid, const LatticeDomain& domain) {
  const std::size_t num_chunks = (grid.num_cells() + kLeavesPerChunk - 1) / kLeavesPerChunk;
  std::vector<BrickCollector> collectors(grid.finest_level, BrickCollector(num_chunks));
  parallel_chunks(grid.num_cells(), kLeavesPerChunk, [&](std::size_t begin, std::size_t end) {
    AncestorStream stream(grid, domain);
    for (std::size_t i = begin; i < end; ++i) stream.add(grid.cells.raw()[i]);
    for (int d = 0; d < grid.finest_level; ++d)
      collectors[d].list(begin / kLeavesPerChunk) = std::move(stream.bricks(d));
  });
  NestedSets sets;
  for (BrickCollector& collector : collectors) sets.push_back(collector.take());
  return sets;
}

// Tasks are counted first, so that each knows where its leaves begin and writes them in place.
Grid grid_of(const NestedSets& sets, const Grid& like, const LatticeDomain& domain) {
  Grid out;
  out.frame = like.frame;
  out.roots = like.roots;
  out.finest_level = static_cast<int>(sets.size());
  const LeafWriter writer(sets, domain, out);
  std::vector<Subtree> tasks = make_subtrees(writer, domain);
  std::vector<std::size_t> sizes(tasks.size());
  parallel_for(
      tasks.size(), [&](std::size_t i) { sizes[i] = writer.count(tasks[i].node, tasks[i].depth); },
      16);
  std::size_t total = 0;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    tasks[i].first_leaf = total;
    total += sizes[i];
  }
  out.cells.reserve(total);
  prefault_pages(out.cells.raw().data(), total * sizeof(GridCell));
  out.cells.resize(total);
  parallel_for(
      tasks.size(),
      [&](std::size_t i) { writer.write(tasks[i].node, tasks[i].depth, tasks[i].first_leaf); }, 1);
  return out;
}

}  // namespace hexwright::grids
