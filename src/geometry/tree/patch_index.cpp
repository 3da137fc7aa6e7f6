// Marks the branches of a tree that hold a single patch.
#include "hexwright/geometry/patch_index.h"

#include <utility>

#include "hexwright/base/assert.h"

#include "geometry/tree/triangle_bvh.h"

namespace hexwright {

PatchIndex::PatchIndex(const SurfaceTree& tree, IdVector<TriId, PatchId> tri_to_patch)
    : tri_to_patch_(std::move(tri_to_patch)) {
  const TriangleBvh& bvh = tree.bvh();
  HEXWRIGHT_ASSERT(tri_to_patch_.size() == bvh.slot_to_tri.size());
  slot_to_patch_.reserve(bvh.slot_to_tri.size());
  for (TriId t : bvh.slot_to_tri) slot_to_patch_.push_back(tri_to_patch_[t].value());
  nodes_.resize(bvh.nodes.size());
  if (!nodes_.empty()) fill_node(bvh, 0);
}

/// Tells for each child whether all below it is one patch, so that a search for another passes it
/// by.
std::int32_t PatchIndex::fill_node(const TriangleBvh& bvh, int node_id) {
  const BvhNode& node = bvh.nodes[static_cast<std::size_t>(node_id)];
  OfNode& of_node = nodes_[static_cast<std::size_t>(node_id)];
  constexpr std::int32_t kNone = -3;
  const auto merge = [](std::int32_t a, std::int32_t b) {
    return a == kNone || a == b ? b : kMixed;
  };
  std::int32_t all = kNone;
  for (int k = 0; k < 4; ++k) {
    std::int32_t patch = kNone;
    if (!node.is_leaf(k)) {
      patch = fill_node(bvh, node.child[k]);
    } else {
      if (node.leaf_count(k) == 0) continue;
      for (int i = 0; i < node.leaf_count(k); ++i)
        patch = merge(patch, slot_to_patch_[static_cast<std::size_t>(node.leaf_first(k) + i)]);
    }
    of_node.patch[k] = patch;
    all = merge(all, patch);
  }
  return all;
}

}  // namespace hexwright
