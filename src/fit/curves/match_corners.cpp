// Greedy matching of corners to vertices.
#include "fit/curves/match_corners.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace hexwright::fitting {

using namespace relax;

CornerEnds find_corner_ends(const FeatureGraph& features,
                            const IdVector<CurveId, char>& is_banned) {
  CornerEnds ends;
  ends.curve_to_corners.assign(features.curves.size(), {-1, -1});
  ends.degree.assign(features.corners.size(), 0);
  const auto index_of = [&](VertId v) {
    const auto it = std::lower_bound(features.corners.begin(), features.corners.end(), v);
    return static_cast<int>(it - features.corners.begin());
  };
  for (CurveId c : features.curves.ids()) {
    const FeatureCurve& curve = features.curves[c];
    if (curve.is_closed) continue;
    ends.curve_to_corners[c] = {index_of(curve.verts.front()), index_of(curve.verts.back())};
    if (!is_banned.empty() && is_banned[c]) continue;
    for (int corner : ends.curve_to_corners[c]) ++ends.degree[static_cast<std::size_t>(corner)];
  }
  return ends;
}

double corner_cost(const BoundaryQuads& boundary, const BoundaryGraph& graph, VertId vert,
                   const Vec3& corner, int degree) {
  const double d = distance(boundary.positions[vert], corner) / boundary.edge_length[vert];
  return d + std::max(0, degree - static_cast<int>(graph.valence(vert)));
}

std::vector<VertId> match_corners(const BoundaryQuads& boundary, const BoundaryGraph& graph,
                                  const VertReach& reach_tree, const TriMesh& surface,
                                  const FeatureGraph& features, const CornerEnds& ends,
                                  const std::vector<double>& reach) {
  std::vector<std::size_t> order(features.corners.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t x, std::size_t y) { return ends.degree[x] > ends.degree[y]; });
  std::vector<VertId> result(features.corners.size());
  std::vector<char> is_taken(graph.num_verts(), 0);
  std::vector<VertId> found;
  for (std::size_t corner : order) {
    if (ends.degree[corner] == 0) continue;
    const Vec3& p = surface.positions[features.corners[corner]];
    found.clear();
    reach_tree.find({p, p}, found);
    double best = std::numeric_limits<double>::infinity();
    for (VertId v : found) {
      if (is_taken[v.index()]) continue;
      if (distance(boundary.positions[v], p) > reach[corner] * boundary.edge_length[v]) continue;
      const double cost = corner_cost(boundary, graph, v, p, ends.degree[corner]);
      if (cost < best || (cost == best && v < result[corner])) {
        best = cost;
        result[corner] = v;
      }
    }
    if (result[corner].is_valid()) is_taken[result[corner].index()] = 1;
  }
  return result;
}

}  // namespace hexwright::fitting
