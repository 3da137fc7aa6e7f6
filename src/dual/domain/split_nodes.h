// The split nodes of one depth, in sibling groups, with the parities of their core planes.
//
// Siblings share a vertex, so they always lie in one cluster: the group is the unit of storage.
#pragma once

#include <cstdint>
#include <vector>

#include "hexwright/grid/grid.h"

namespace hexwright::dual {

/// Up to eight split nodes with one parent. For depth 0 the "parent" is a 2x2x2 box of roots.
struct NodeGroup {
  LatticeCoord parent = {0, 0, 0};
  std::uint8_t children = 0;  ///< bit (x | y << 1 | z << 2) of each child that is split
  std::uint8_t parity = 0;    ///< bit a: core planes of axis a have odd coordinates at this depth
};

/// Set of nodes of one depth with look-up by integer hashing.
class SplitNodes {
 public:
  /// Adds a node (coordinates on its depth's lattice); repetitions are harmless.
  void insert(const LatticeCoord& node);

  std::size_t num_groups() const { return groups_.size(); }
  std::size_t num_nodes() const;
  const std::vector<NodeGroup>& groups() const { return groups_; }
  std::vector<NodeGroup>& groups() { return groups_; }

  /// Index of the group with this parent, or -1.
  std::int32_t find_group(const LatticeCoord& parent) const;
  bool contains(const LatticeCoord& node) const;
  /// A group with a node whose closed cell contains the point, or -1. The point is given in half
  /// spacings: even coordinates are lattice planes of this depth.
  std::int32_t find_group_around(const LatticeCoord& half_spaced) const;

 private:
  void rehash(std::size_t capacity);
  std::size_t slot_of(const LatticeCoord& parent) const;

  std::vector<NodeGroup> groups_;
  std::vector<std::int32_t> table_;  // open addressing: group index or -1; a power of two long
  std::int32_t last_group_ = -1;     // nodes come in Morton order: siblings follow each other
};

/// Children on the low [0] and the high side [1] of each axis, as masks over the eight child bits.
inline constexpr std::array<std::array<int, 2>, 3> kSideMask = {
    {{0x55, 0xAA}, {0x33, 0xCC}, {0x0F, 0xF0}}};

/// Bit of a node within its group, and the parent's coordinates.
inline int child_bit(const LatticeCoord& node) {
  return 1 << ((node[0] & 1) | (node[1] & 1) << 1 | (node[2] & 1) << 2);
}
inline LatticeCoord parent_of(const LatticeCoord& node) {
  return {node[0] >> 1, node[1] >> 1, node[2] >> 1};
}

/// The split nodes of a grid, one set per depth 0 .. finest_level - 1.
std::vector<SplitNodes> collect_split_nodes(const Grid& grid);

}  // namespace hexwright::dual
