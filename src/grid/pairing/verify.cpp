// Checks of a finished grid: balance, the existence of a conflict-free block decomposition, and
// that it refines the grid it was made from.
//
// Independent of how the grid was made: all checks start from the leaves alone.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/grid/complete.h"

#include "grid/pairing/balance.h"
#include "grid/pairing/blocks.h"
#include "grid/sets/nested_sets.h"
#include "labelling/labelling.h"

namespace hexwright {

using namespace grids;

namespace {

void check_grid(const Grid& grid, const char* caller) {
  if (const auto issue = grid.find_problem())
    throw Error(ErrorCode::BadArgument, fmt::format("{}: {}", caller, issue->message));
}

std::string name_of(const char* noun, const LatticeCoord& node, int depth,
                    const LatticeDomain& domain) {
  const LatticeCoord at = domain.unshifted(node, depth);
  return fmt::format("{} (level {}, index {} {} {})", noun, depth, at[0], at[1], at[2]);
}

/// First node of `wanted` that is missing from `present`.
std::optional<LatticeCoord> find_missing(const BrickSet& wanted, const BrickSet& present) {
  for (const Brick& brick : wanted.bricks())
    if (const BrickBits missing = brick.bits & ~present.bits(brick.key))
      return node_of_bit(brick.key, std::countr_zero(missing));
  return std::nullopt;
}

/// The leaf that covers a node which does not exist: its lowest ancestor whose parent is split.
std::pair<LatticeCoord, int> covering_leaf(const NestedSets& sets, LatticeCoord node, int depth) {
  while (depth > 0) {
    const LatticeCoord parent = {node[0] >> 1, node[1] >> 1, node[2] >> 1};
    if (sets[depth - 1].contains(parent)) break;
    node = parent;
    --depth;
  }
  return {node, depth};
}

/// A split node of `depth` with a neighbour whose parent is `unsplit`.
LatticeCoord split_node_beside(const BrickSet& split, const LatticeCoord& unsplit,
                               Balance balance) {
  for (int i = 0; i < 64; ++i) {
    const LatticeCoord step = {i % 4 - 1, i / 4 % 4 - 1, i / 16 - 1};
    int num_outside = 0;
    for (const int s : step) num_outside += s < 0 || s > 1;
    if (num_outside > (balance == Balance::Weak ? 1 : 3)) continue;
    const LatticeCoord node = {2 * unsplit[0] + step[0], 2 * unsplit[1] + step[1],
                               2 * unsplit[2] + step[2]};
    if (split.contains(node)) return node;
  }
  return unsplit;
}

/// Names a node that a cluster's best-fitting block parity would still have to split.
Issue incomplete_block(const BrickSet& split, const Clusters& clusters, std::uint32_t cluster,
                       const LabelCosts& costs, int depth, const LatticeDomain& domain) {
  const auto best =
      static_cast<Parity>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  std::vector<Brick> own;
  for (const Piece& piece : clusters.pieces)
    if (piece.cluster == cluster) own.push_back({split.bricks()[piece.brick].key, piece.bits});
  const BrickSet nodes(std::move(own));
  const auto missing = find_missing(blocks_of_parity(nodes, best, depth, domain), nodes);
  const Brick& first = nodes.bricks().front();
  return {fmt::format(
      "the split nodes around {} are no union of 2x2x2 blocks: {} is not split",
      name_of("node", node_of_bit(first.key, std::countr_zero(first.bits)), depth, domain),
      name_of("node", missing.value_or(LatticeCoord{}), depth, domain))};
}

const Conflict* find_crossed(const std::vector<Conflict>& conflicts,
                             const std::vector<std::uint8_t>& labels) {
  for (const Conflict& c : conflicts)
    if (c.forbidden >> (8 * labels[c.first] + labels[c.second]) & 1) return &c;
  return nullptr;
}

Issue crossed_blocks(const BrickSet& split, const Clusters& clusters, const Conflict& conflict,
                     int depth, const LatticeDomain& domain) {
  const auto first_node = [&](std::uint32_t cluster) {
    const auto piece = std::find_if(clusters.pieces.begin(), clusters.pieces.end(),
                                    [&](const Piece& p) { return p.cluster == cluster; });
    return name_of("node",
                   node_of_bit(split.bricks()[piece->brick].key, std::countr_zero(piece->bits)),
                   depth, domain);
  };
  return {fmt::format("the blocks around {} and {} are closer than four without being aligned",
                      first_node(conflict.first), first_node(conflict.second))};
}

std::optional<Issue> find_unpaired_depth(const BrickSet& split, int depth,
                                         const LatticeDomain& domain) {
  const Clusters clusters = find_clusters(split);
  std::vector<std::int64_t> sizes(clusters.num_clusters, 0);
  for (const Piece& p : clusters.pieces) sizes[p.cluster] += std::popcount(p.bits);
  // Excess: nodes that the blocks of each parity would add. A decomposition has none.
  auto excess = block_costs(split, clusters, depth, domain);
  for (std::uint32_t k = 0; k < clusters.num_clusters; ++k) {
    for (std::int64_t& c : excess[k]) c -= sizes[k];
    if (*std::min_element(excess[k].begin(), excess[k].end()) > 0)
      return incomplete_block(split, clusters, k, excess[k], depth, domain);
    for (std::int64_t& c : excess[k]) c = c > 0 ? 1 : 0;
  }
  const auto conflicts = find_conflicts(split, clusters);
  std::vector<std::uint8_t> labels(clusters.num_clusters);
  for (std::uint32_t k = 0; k < clusters.num_clusters; ++k)
    labels[k] = static_cast<std::uint8_t>(std::find(excess[k].begin(), excess[k].end(), 0) -
                                          excess[k].begin());
  const Conflict* crossed = find_crossed(conflicts, labels);
  // Clusters at the domain's border may fit several parities: let the solver choose. A cost of
  // zero means that every cluster has a parity without excess, and no two exclude each other.
  if (!crossed || solve_labels(excess, conflicts).cost == 0) return std::nullopt;
  return crossed_blocks(split, clusters, *crossed, depth, domain);
}

std::optional<Issue> find_unbalanced_by_two(const NestedSets& sets, const LatticeDomain& domain) {
  for (int d = 2; d < static_cast<int>(sets.size()); ++d) {
    const BrickSet needed = required_two_above(sets[d], d, domain, BrickSet());
    const auto missing = find_missing(needed, sets[d - 2]);
    if (!missing) continue;
    const auto [leaf, level] = covering_leaf(sets, *missing, d - 2);
    return Issue{fmt::format("{} is too coarse: it has neighbours of level {}",
                             name_of("cell", leaf, level, domain), d + 1)};
  }
  return std::nullopt;
}

/// Whether both lattices lie at the same place; files keep about nine digits of a frame.
bool is_same_frame(const GridFrame& a, const GridFrame& b) {
  constexpr double kTolRelRoot = 1e-6;
  const double room = kTolRelRoot * a.root_size;
  return std::abs(a.root_size - b.root_size) <= room && distance(a.origin, b.origin) <= room &&
         distance(a.stretch, b.stretch) <= kTolRelRoot;
}

}  // namespace

std::optional<Issue> find_unbalanced(const Grid& grid, Balance balance) {
  check_grid(grid, "find_unbalanced");
  const LatticeDomain domain(grid.roots, grid.finest_level);
  const NestedSets sets = split_sets_of(grid, domain);
  if (balance == Balance::Relaxed) return find_unbalanced_by_two(sets, domain);
  for (int d = 1; d < static_cast<int>(sets.size()); ++d) {
    const BrickSet needed = required_above(sets[d], d, balance, domain, BrickSet());
    const auto missing = find_missing(needed, sets[d - 1]);
    if (!missing) continue;
    const auto [leaf, level] = covering_leaf(sets, *missing, d - 1);
    const LatticeCoord fine = split_node_beside(sets[d], *missing, balance);
    return Issue{fmt::format("{} is too coarse: its neighbour {} is split once more",
                             name_of("cell", leaf, level, domain),
                             name_of("node", fine, d, domain))};
  }
  return std::nullopt;
}

std::optional<Issue> find_unpaired(const Grid& grid) {
  check_grid(grid, "find_unpaired");
  const LatticeDomain domain(grid.roots, grid.finest_level);
  const NestedSets sets = split_sets_of(grid, domain);
  for (int d = 0; d < static_cast<int>(sets.size()); ++d)
    if (auto issue = find_unpaired_depth(sets[d], d, domain)) return issue;
  return std::nullopt;
}

std::optional<Issue> find_coarsened(const Grid& grid, const Grid& input) {
  check_grid(grid, "find_coarsened");
  check_grid(input, "find_coarsened");
  if (grid.roots != input.roots)
    return Issue{fmt::format("its {} root cube(s) are not the {} of the input grid",
                             grid.roots.size(), input.roots.size())};
  if (!is_same_frame(grid.frame, input.frame))
    return Issue{"it lies at another place or has another size than the input grid"};
  const LatticeDomain domain(grid.roots, std::max(grid.finest_level, input.finest_level));
  const NestedSets sets = split_sets_of(grid, domain);
  const NestedSets needed = split_sets_of(input, domain);
  for (int d = 0; d < static_cast<int>(needed.size()); ++d) {
    const BrickSet present = d < static_cast<int>(sets.size()) ? sets[d] : BrickSet();
    const auto missing = find_missing(needed[d], present);
    if (!missing) continue;
    // Depth by depth from the roots: the missing node's parent is split, so it is a leaf itself.
    return Issue{fmt::format("{} is coarser than the input grid, where it is split",
                             name_of("cell", *missing, d, domain))};
  }
  return std::nullopt;
}

}  // namespace hexwright
