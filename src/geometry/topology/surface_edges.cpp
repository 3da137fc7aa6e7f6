// Edges by sorting the sides of all triangles: deterministic and free of hashing.
#include "geometry/topology/surface_edges.h"

#include <algorithm>

#include "hexwright/base/parallel.h"

namespace hexwright {

SurfaceEdges compute_surface_edges(const TriMesh& surface) {
  struct KeyedSide {
    std::uint64_t key;
    SurfaceEdges::Side side;
  };
  std::vector<KeyedSide> keyed;
  keyed.reserve(3 * surface.num_tris());
  for (TriId t : surface.tris.ids()) {
    const auto& v = surface.tris[t];
    for (int k = 0; k < 3; ++k) {
      const VertId a = v[static_cast<std::size_t>(k)];
      const VertId b = v[static_cast<std::size_t>((k + 1) % 3)];
      if (a != b) keyed.push_back({edge_key(a, b), {t, k, a < b}});
    }
  }
  parallel_stable_sort(keyed.begin(), keyed.end(),
                       [](const KeyedSide& a, const KeyedSide& b) { return a.key < b.key; });
  SurfaceEdges edges;
  edges.sides.reserve(keyed.size());
  for (const KeyedSide& k : keyed) {
    if (edges.keys.empty() || edges.keys.back() != k.key) {
      edges.keys.push_back(k.key);
      edges.edge_to_side.push_back(static_cast<int>(edges.sides.size()));
    }
    edges.sides.push_back(k.side);
  }
  edges.edge_to_side.push_back(static_cast<int>(edges.sides.size()));
  return edges;
}

long SurfaceEdges::find(VertId a, VertId b) const {
  const std::uint64_t key = edge_key(a, b);
  const auto it = std::lower_bound(keys.begin(), keys.end(), key);
  return it != keys.end() && *it == key ? it - keys.begin() : -1;
}

std::vector<int> number_sets(UnionFind& sets, std::size_t count) {
  std::vector<int> number(count, -1);
  int next = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto root = static_cast<std::size_t>(sets.find(static_cast<int>(i)));
    if (number[root] < 0) number[root] = next++;  // the root is the least element: root <= i
    number[i] = number[root];
  }
  return number;
}

}  // namespace hexwright
