// The edges of a triangle surface with the triangles around each, for any soup.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hexwright/mesh/tri_mesh.h"

#include "base/disjoint_sets.h"

namespace hexwright {

/// The order-independent key of an edge; keys sort by lower vertex, then by higher vertex.
inline std::uint64_t edge_key(VertId a, VertId b) {
  const auto lo = static_cast<std::uint64_t>(std::min(a, b).value());
  const auto hi = static_cast<std::uint64_t>(std::max(a, b).value());
  return lo << 32 | hi;
}

/// Edges in increasing order of key. Triangle sides that repeat a vertex are no edges.
struct SurfaceEdges {
  /// One side of a triangle. It runs from vertex k to vertex k + 1 of the triangle.
  struct Side {
    TriId tri;
    std::int32_t k = 0;
    bool is_forward = true;  ///< runs from the lower to the higher vertex
  };

  std::vector<std::uint64_t> keys;  ///< one per edge, increasing
  std::vector<int> edge_to_side;    ///< CSR offsets into sides, num_edges + 1 entries
  std::vector<Side> sides;          ///< by edge, then by triangle

  std::size_t size() const { return keys.size(); }
  VertId lo(std::size_t e) const { return VertId(keys[e] >> 32); }
  VertId hi(std::size_t e) const { return VertId(keys[e] & 0xffffffffu); }
  std::span<const Side> sides_of(std::size_t e) const {
    return {sides.data() + edge_to_side[e], sides.data() + edge_to_side[e + 1]};
  }
  /// Number of the edge, or -1 when the surface has none between a and b.
  long find(VertId a, VertId b) const;
};

SurfaceEdges compute_surface_edges(const TriMesh& surface);

/// Over the 32-bit numbers of triangles, vertices or curves.
using UnionFind = BasicDisjointSets<int>;

/// Numbers the sets 0, 1, ... in the order of their least elements.
std::vector<int> number_sets(UnionFind& sets, std::size_t count);

}  // namespace hexwright
