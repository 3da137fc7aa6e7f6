// A four-wide bounding volume hierarchy over triangles.
//
// Based on: Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007 (binned
// surface area heuristic); Dammertz, Hanika, Keller, "Shallow bounding volume hierarchies", 2008
// (four children per node).
// Differs: boxes are floats in coordinates normalised to the object's box, rounded outwards; so a
// node fits two cache lines whatever the scale and position of the object.
#pragma once

#include <cstdint>
#include <vector>

#include "hexwright/mesh/tri_mesh.h"

#include "geometry/tree/simd.h"

namespace hexwright {

struct BvhNode {
  Float4 lo[3], hi[3];  ///< per axis, per child; an unused child has lo > hi
  /// Inner child: number of its node. Leaf: ~(first * 8 + count) with at most 4 triangles.
  std::int32_t child[4];

  bool is_leaf(int k) const { return child[k] < 0; }
  int leaf_first(int k) const {
    return static_cast<int>(static_cast<std::uint32_t>(~child[k]) / 8);
  }
  int leaf_count(int k) const { return ~child[k] & 7; }
};

/// Maps world positions into the cube [-1, 1]^3 around the object.
struct BvhFrame {
  Vec3 center;
  double inverse_scale = 1;
};

struct TriangleBvh {
  BvhFrame frame;
  std::vector<BvhNode> nodes;      ///< the root first; empty without triangles
  std::vector<TriId> slot_to_tri;  ///< the order of triangles in the leaves
  int depth = 0;                   ///< nodes on the longest path from the root
};

/// Deepest hierarchy that is ever built; queries size their stacks by it.
constexpr int kMaxBvhDepth = 64;

TriangleBvh build_triangle_bvh(const TriMesh& surface);

}  // namespace hexwright
