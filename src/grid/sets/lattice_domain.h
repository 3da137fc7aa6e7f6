// Which lattice nodes exist: the union of root cubes, seen from every depth.
//
// Inside balance and pairing, lattice coordinates are shifted by an even number of roots so that
// they are never negative, even for the neighbours of the outermost nodes; parities stay the same.
#pragma once

#include <array>
#include <vector>

#include "grid/sets/brick.h"

namespace hexwright::grids {

class LatticeDomain {
 public:
  /// Throws Error{OutOfResources} when roots that lie far apart are split too deeply.
  LatticeDomain(const std::vector<LatticeCoord>& roots, int finest_level);

  const std::vector<LatticeCoord>& shifted_roots() const { return roots_; }
  /// Added to a root's coordinates to get its shifted ones.
  const LatticeCoord& shift() const { return shift_; }
  /// Coordinates in the grid's own lattice of that depth, for messages.
  LatticeCoord unshifted(const LatticeCoord& node, int depth) const;

  bool contains(const LatticeCoord& node, int depth) const {
    return contains_root({node[0] >> depth, node[1] >> depth, node[2] >> depth});
  }
  /// The brick's nodes that exist.
  BrickBits mask(BrickKey key, int depth) const;
  /// As mask(other), for a neighbour of a brick that has nodes: those of one root share its key's
  /// leading bits, which spares most neighbours the way back to coordinates.
  BrickBits neighbour_mask(BrickKey own, BrickKey other, int depth) const {
    if (depth >= 2 && (own ^ other) >> 3 * (depth - 2) == 0) return ~BrickBits{0};
    return mask(other, depth);
  }
  /// Whether the brick and its 26 neighbours exist in full.
  bool is_interior(BrickKey key, int depth) const;

 private:
  void tabulate_roots();
  std::size_t table_index(const LatticeCoord& root) const {
    return static_cast<std::size_t>(root[0] - low_[0]) +
           size_[0] * (static_cast<std::size_t>(root[1] - low_[1]) +
                       std::size_t{size_[1]} * static_cast<std::size_t>(root[2] - low_[2]));
  }
  bool contains_root(const LatticeCoord& root) const {
    for (int a = 0; a < 3; ++a)
      if (static_cast<std::uint32_t>(root[a] - low_[a]) >= size_[a]) return false;
    return is_root_.empty() ? is_listed(root) : is_root_[table_index(root)] != 0;
  }
  bool is_listed(const LatticeCoord& root) const;

  LatticeCoord shift_ = {0, 0, 0};
  std::vector<LatticeCoord> roots_;                ///< shifted, sorted by root_less
  LatticeCoord low_ = {0, 0, 0};                   ///< lowest coordinates of the roots
  std::array<std::uint32_t, 3> size_ = {0, 0, 0};  ///< of the roots' box
  std::vector<char> is_root_;  ///< per cube of that box; empty when there are too many
};

}  // namespace hexwright::grids
