// The patches of a surface's triangles, as closest-point queries restricted to one patch need them.
#pragma once

#include <cstdint>
#include <vector>

#include "hexwright/geometry/surface_tree.h"

namespace hexwright {

/// Which patch each triangle of a tree belongs to, and which branches of the tree hold a single
/// patch. Immutable; one tree may have any number of them at the same time.
class PatchIndex {
 public:
  /// No triangle has a patch: queries for one find nothing.
  PatchIndex() = default;
  /// One patch per triangle of the tree. Queries that use the index must go to the same tree.
  PatchIndex(const SurfaceTree& tree, IdVector<TriId, PatchId> tri_to_patch);

  bool empty() const { return tri_to_patch_.empty(); }
  /// Invalid when there are no patches.
  PatchId patch(TriId t) const { return empty() ? PatchId() : tri_to_patch_[t]; }

 private:
  friend class SurfaceTree;
  /// Per child of a node: the patch of all triangles below, or kMixed.
  struct OfNode {
    std::int32_t patch[4] = {kMixed, kMixed, kMixed, kMixed};
  };
  static constexpr std::int32_t kMixed = -2;
  std::int32_t fill_node(const TriangleBvh& bvh, int node);

  IdVector<TriId, PatchId> tri_to_patch_;
  std::vector<std::int32_t> slot_to_patch_;  // in the order of the tree's leaves
  std::vector<OfNode> nodes_;                // per node of the tree
};

}  // namespace hexwright
