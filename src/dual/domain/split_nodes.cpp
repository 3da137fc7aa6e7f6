// An open-addressing table from a parent's coordinates to the group of its split children. Cells
// come in Morton order, so the last group answers most insertions without a look-up.
#include "dual/domain/split_nodes.h"

#include <bit>

namespace hexwright::dual {

namespace {

// Coordinates of neighbours differ in low bits only: multiplied by odd constants and folded, so
// that the table's low bits depend on all of them. Negative coordinates wrap, which does no harm.
std::uint64_t hash_coord(const LatticeCoord& p) {
  std::uint64_t h = static_cast<std::uint32_t>(p[0]) * 0x9E3779B97F4A7C15ull;
  h = (h ^ (h >> 29)) + static_cast<std::uint32_t>(p[1]) * 0xBF58476D1CE4E5B9ull;
  h = (h ^ (h >> 31)) + static_cast<std::uint32_t>(p[2]) * 0x94D049BB133111EBull;
  h ^= h >> 30;
  h *= 0x9E3779B97F4A7C15ull;
  return h ^ (h >> 32);
}

}  // namespace

std::size_t SplitNodes::slot_of(const LatticeCoord& parent) const {
  const std::size_t mask = table_.size() - 1;
  std::size_t slot = hash_coord(parent) & mask;
  while (table_[slot] >= 0 && groups_[static_cast<std::size_t>(table_[slot])].parent != parent)
    slot = (slot + 1) & mask;
  return slot;
}

// Groups never go away, so there are no tombstones; a new table is filled in order of groups.
void SplitNodes::rehash(std::size_t capacity) {
  table_.assign(capacity, -1);
  for (std::size_t g = 0; g < groups_.size(); ++g)
    table_[slot_of(groups_[g].parent)] = static_cast<std::int32_t>(g);
}

std::int32_t SplitNodes::find_group(const LatticeCoord& parent) const {
  return table_.empty() ? -1 : table_[slot_of(parent)];
}

void SplitNodes::insert(const LatticeCoord& node) {
  const LatticeCoord parent = parent_of(node);
  std::int32_t g = last_group_;
  if (g < 0 || groups_[static_cast<std::size_t>(g)].parent != parent) g = find_group(parent);
  if (g < 0) {
    g = static_cast<std::int32_t>(groups_.size());
    groups_.push_back({parent, 0, 0});
    if (2 * groups_.size() > table_.size())
      rehash(std::max<std::size_t>(16, 2 * table_.size()));
    else
      table_[slot_of(parent)] = g;
  }
  groups_[static_cast<std::size_t>(g)].children |= static_cast<std::uint8_t>(child_bit(node));
  last_group_ = g;
}

std::size_t SplitNodes::num_nodes() const {
  std::size_t count = 0;
  for (const NodeGroup& g : groups_) count += static_cast<std::size_t>(std::popcount(g.children));
  return count;
}

bool SplitNodes::contains(const LatticeCoord& node) const {
  const std::int32_t g = find_group(parent_of(node));
  return g >= 0 && (groups_[static_cast<std::size_t>(g)].children & child_bit(node));
}

std::int32_t SplitNodes::find_group_around(const LatticeCoord& half_spaced) const {
  // Per axis: the one or two parents of the nodes around the point, and their sides that touch it.
  struct Candidate {
    std::int32_t parent;
    int mask;
  };
  std::array<std::array<Candidate, 2>, 3> candidates;
  std::array<int, 3> count;
  for (int a = 0; a < 3; ++a) {
    const std::int32_t node = half_spaced[a] >> 1;  // the cell above, or around
    const auto& side = kSideMask[a];
    candidates[a][0] = {node >> 1, side[node & 1]};
    count[a] = 1;
    if (half_spaced[a] & 1) continue;
    if (node & 1) {
      candidates[a][0].mask = 0xFF;
    } else {
      candidates[a][1] = {(node >> 1) - 1, side[1]};
      count[a] = 2;
    }
  }
  for (int i = 0; i < count[0]; ++i)
    for (int j = 0; j < count[1]; ++j)
      for (int k = 0; k < count[2]; ++k) {
        const Candidate &x = candidates[0][i], &y = candidates[1][j], &z = candidates[2][k];
        const std::int32_t g = find_group({x.parent, y.parent, z.parent});
        if (g >= 0 && (groups_[static_cast<std::size_t>(g)].children & x.mask & y.mask & z.mask))
          return g;
      }
  return -1;
}

std::vector<SplitNodes> collect_split_nodes(const Grid& grid) {
  std::vector<SplitNodes> split(static_cast<std::size_t>(grid.finest_level));
  // Cells are in Morton order, so equal ancestors are consecutive: stop at the first known one.
  std::vector<LatticeCoord> last(split.size());
  std::vector<char> is_set(split.size(), 0);
  for (const GridCell& cell : grid.cells)
    for (int depth = cell.level - 1; depth >= 0; --depth) {
      const int shift = grid.finest_level - depth;
      const LatticeCoord node = {cell.corner[0] >> shift, cell.corner[1] >> shift,
                                 cell.corner[2] >> shift};
      const auto d = static_cast<std::size_t>(depth);
      if (is_set[d] && last[d] == node) break;
      split[d].insert(node);
      last[d] = node;
      is_set[d] = 1;
    }
  return split;
}

}  // namespace hexwright::dual
