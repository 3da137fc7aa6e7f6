#include "dual/random_grids.h"

#include <random>

namespace hexwright::test {
namespace {

using Random = std::mt19937;

int pick(Random& random, int count) {
  return static_cast<int>(random() % static_cast<unsigned>(count));
}

LatticeCoord random_existing_node(const SplitTree& tree, int depth, Random& random) {
  if (depth == 0) return tree.roots()[random() % tree.roots().size()];
  const auto& parents = tree.split_at(depth - 1);
  const auto parent = *std::next(parents.begin(), pick(random, static_cast<int>(parents.size())));
  return {2 * parent[0] + pick(random, 2), 2 * parent[1] + pick(random, 2),
          2 * parent[2] + pick(random, 2)};
}

// Splits up to `max_nodes` random nodes on each of a few depths.
SplitTree scatter_splits(const std::vector<LatticeCoord>& roots, Random& random, int max_nodes) {
  SplitTree tree(roots);
  const int num_depths = 1 + pick(random, 4);
  for (int depth = 0; depth < num_depths && depth <= tree.num_depths(); ++depth)
    for (int n = 1 + pick(random, max_nodes); n > 0; --n)
      tree.split(depth, random_existing_node(tree, depth, random));
  return tree;
}

// Adds to each split node the rest of its block: `parity` says, per axis, whether centres are odd.
void fill_blocks(SplitTree& tree, int depth, const LatticeCoord& parity) {
  for (const LatticeCoord n : std::set<LatticeCoord>(tree.split_at(depth))) {
    LatticeCoord center = n;
    for (int a = 0; a < 3; ++a) center[a] += (n[a] & 1) != parity[a];
    tree.split_block({depth, center});
  }
}

}  // namespace

std::vector<LatticeCoord> random_box(unsigned seed) {
  Random random(seed);
  const int nx = 1 + pick(random, 4), ny = 1 + pick(random, 4);
  return box_roots(nx, ny, 1 + pick(random, 4));
}

std::vector<LatticeCoord> random_domain(unsigned seed) {
  Random random(seed);
  std::set<LatticeCoord> roots;
  LatticeCoord corner = {0, 0, 0};
  for (int n = 2 + pick(random, 4); n > 0; --n) {
    for (const LatticeCoord& r : box_roots(2, 2, 2))
      roots.insert({corner[0] + r[0], corner[1] + r[1], corner[2] + r[2]});
    corner[static_cast<std::size_t>(pick(random, 3))] += 1 + pick(random, 2);
    if (pick(random, 3) == 0) corner = {pick(random, 3), pick(random, 3), pick(random, 3)};
  }
  return {roots.begin(), roots.end()};
}

SplitTree random_balanced_tree(unsigned seed, const std::vector<LatticeCoord>& roots) {
  Random random(seed);
  SplitTree tree = scatter_splits(roots, random, 6);
  tree.balance(seed % 2 == 1);
  return tree;
}

SplitTree random_unbalanced_tree(unsigned seed, const std::vector<LatticeCoord>& roots) {
  Random random(seed);
  return scatter_splits(roots, random, 8);
}

SplitTree random_paired_tree(unsigned seed, const std::vector<LatticeCoord>& roots) {
  Random random(seed);
  SplitTree tree = scatter_splits(roots, random, 3);
  for (int depth = tree.num_depths() - 1; depth >= 0; --depth) {
    fill_blocks(tree, depth, {pick(random, 2), pick(random, 2), pick(random, 2)});
    tree.balance(seed % 2 == 1);
  }
  return tree;
}

}  // namespace hexwright::test
