#include "dual/dual_helpers.h"

#include <algorithm>

namespace hexwright::test {

std::vector<LatticeCoord> box_roots(int nx, int ny, int nz) {
  std::vector<LatticeCoord> roots;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) roots.push_back({x, y, z});
  return roots;
}

SplitTree::SplitTree(std::vector<LatticeCoord> roots)
    : roots_(std::move(roots)), root_set_(roots_.begin(), roots_.end()) {}

bool SplitTree::contains(int depth, const LatticeCoord& n) const {
  return root_set_.count({n[0] >> depth, n[1] >> depth, n[2] >> depth}) > 0;
}

bool SplitTree::is_split(int depth, const LatticeCoord& node) const {
  return depth < num_depths() && split_at(depth).count(node) > 0;
}

bool SplitTree::exists(int depth, const LatticeCoord& n) const {
  return contains(depth, n) &&
         (depth == 0 || is_split(depth - 1, {n[0] >> 1, n[1] >> 1, n[2] >> 1}));
}

void SplitTree::split(int depth, const LatticeCoord& n) {
  if (!contains(depth, n) || is_split(depth, n)) return;
  if (num_depths() <= depth) split_.resize(static_cast<std::size_t>(depth) + 1);
  split_[static_cast<std::size_t>(depth)].insert(n);
  if (depth > 0) split(depth - 1, {n[0] >> 1, n[1] >> 1, n[2] >> 1});
}

void SplitTree::split_block(const BlockSpec& block) {
  for (int q = 0; q < 8; ++q)
    split(block.depth,
          {block.center[0] - (q & 1), block.center[1] - (q >> 1 & 1), block.center[2] - (q >> 2)});
}

void SplitTree::balance(bool is_strong) {
  for (int depth = num_depths() - 1; depth > 0; --depth)
    for (const LatticeCoord n : std::set<LatticeCoord>(split_at(depth)))
      for (int code = 0; code < 27; ++code) {
        const int o[3] = {code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1};
        if (!is_strong && std::abs(o[0]) + std::abs(o[1]) + std::abs(o[2]) > 1) continue;
        const LatticeCoord next = {n[0] + o[0], n[1] + o[1], n[2] + o[2]};
        if (contains(depth, next)) split(depth - 1, {next[0] >> 1, next[1] >> 1, next[2] >> 1});
      }
}

Grid SplitTree::grid() const {
  std::vector<CellSpec> cells;
  std::vector<CellSpec> stack;
  for (const LatticeCoord& root : roots_) stack.push_back({0, root});
  while (!stack.empty()) {
    const CellSpec cell = stack.back();
    stack.pop_back();
    if (!is_split(cell.level, cell.index)) {
      cells.push_back(cell);
      continue;
    }
    for (int q = 0; q < 8; ++q)
      stack.push_back({cell.level + 1,
                       {2 * cell.index[0] + (q & 1), 2 * cell.index[1] + (q >> 1 & 1),
                        2 * cell.index[2] + (q >> 2)}});
  }
  return make_grid({{0, 0, 0}, 1}, roots_, cells);
}

bool SplitTree::is_box() const {
  LatticeCoord lo = roots_.front(), hi = lo;
  for (const LatticeCoord& r : roots_)
    for (int a = 0; a < 3; ++a) {
      lo[a] = std::min(lo[a], r[a]);
      hi[a] = std::max(hi[a], r[a]);
    }
  const int volume = (hi[0] - lo[0] + 1) * (hi[1] - lo[1] + 1) * (hi[2] - lo[2] + 1);
  return static_cast<std::size_t>(volume) == roots_.size();
}

Grid grid_of_splits(const std::vector<LatticeCoord>& roots, const std::vector<NodeSpec>& nodes) {
  SplitTree tree(roots);
  for (const NodeSpec& n : nodes) tree.split(n.depth, n.node);
  return tree.grid();
}

Grid grid_of_blocks(int n, const std::vector<BlockSpec>& blocks) {
  SplitTree tree(box_roots(n, n, n));
  for (const BlockSpec& b : blocks) tree.split_block(b);
  return tree.grid();
}

}  // namespace hexwright::test
