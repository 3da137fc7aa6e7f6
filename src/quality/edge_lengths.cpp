// Each edge once, by sorting the pairs of vertices.
#include "hexwright/quality/edge_lengths.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "hexwright/base/parallel.h"
#include "hexwright/mesh/hex_numbering.h"

namespace hexwright {

EdgeLengths measure_edges(const HexMesh& mesh) {
  constexpr double kHighShare = 0.95;
  std::vector<std::pair<VertId, VertId>> edges(12 * mesh.num_hexes());
  parallel_for(
      mesh.num_hexes(),
      [&](std::size_t h) {
        const auto& hex = mesh.hexes[HexId(h)];
        for (std::size_t e = 0; e < 12; ++e) {
          const VertId a = hex[static_cast<std::size_t>(kHexEdges[e][0])];
          const VertId b = hex[static_cast<std::size_t>(kHexEdges[e][1])];
          edges[12 * h + e] = {std::min(a, b), std::max(a, b)};
        }
      },
      256);
  parallel_stable_sort(edges.begin(), edges.end(), std::less<>());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  EdgeLengths lengths;
  lengths.num_edges = edges.size();
  if (edges.empty()) return lengths;
  std::vector<double> sorted(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e)
    sorted[e] = distance(mesh.positions[edges[e].first], mesh.positions[edges[e].second]);
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  };
  lengths.min = sorted.front();
  lengths.median = at(0.5);
  lengths.high = at(kHighShare);
  lengths.max = sorted.back();
  return lengths;
}

}  // namespace hexwright
