// Which lattice nodes exist: the union of root cubes, seen from every depth.
//
// Inside balance and pairing, lattice coordinates are shifted by an even number of roots so that
// they are never negative, even for the neighbours of the outermost nodes; parities stay the same.
#pragma once

#include <vector>

#include "grid/brick.h"

namespace hexwright {

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
  /// Whether the brick and its 26 neighbours exist in full.
  bool is_interior(BrickKey key, int depth) const;

 private:
  bool contains_root(const LatticeCoord& root) const;

  LatticeCoord shift_ = {0, 0, 0};
  std::vector<LatticeCoord> roots_;  ///< shifted, sorted by root_less
};

}  // namespace hexwright
