// The 48 symmetries of the cube, and the one in which a grid is completed.
//
// Ties between equally cheap blocks are broken by position. Completing every grid in a pose that
// depends on its shape alone makes the number of cells the same for a grid, its rotations and its
// mirror images.
#pragma once

#include <array>

#include "grid/sets/nested_sets.h"

namespace hexwright::grids {

/// Coordinate a of the image is coordinate axis[a] of the original, mirrored when flip[a].
struct Pose {
  std::array<int, 3> axis = {0, 1, 2};
  std::array<bool, 3> flip = {false, false, false};
};

/// Pose number 0 .. 47; 0 is the identity.
Pose make_pose(int number);

/// A domain in a pose, moved so that its lowest root coordinates are zero.
class PosedDomain {
 public:
  PosedDomain(const LatticeDomain& original, const Pose& pose, int finest_level);

  const LatticeDomain& domain() const { return domain_; }
  /// Nodes of the original domain into the posed one, and back.
  BrickSet to_posed(const BrickSet& nodes, int depth) const;
  BrickSet to_original(const BrickSet& nodes, int depth) const;

 private:
  Pose pose_;
  std::array<std::int32_t, 3> offset_ = {0, 0, 0};  ///< of the image, in roots
  LatticeDomain domain_;
};

/// The pose whose image of the sets comes first in an order of images; the identity when that is
/// among the first. Time linear in the bricks of the coarse depths that tell the poses apart: of
/// all depths for symmetric grids.
Pose choose_pose(const NestedSets& sets, const LatticeDomain& domain);
inline bool is_identity(const Pose& pose) {
  return pose.axis == std::array{0, 1, 2} && pose.flip == std::array{false, false, false};
}

}  // namespace hexwright::grids
