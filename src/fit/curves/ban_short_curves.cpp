// Lengths are counted in edges of each curve's own surroundings, so that small features survive
// where the mesh is fine.
#include "fit/curves/ban_short_curves.h"

#include <algorithm>

#include "geometry/topology/surface_edges.h"

namespace hexwright::fitting {

using namespace relax;
namespace {

constexpr int kRounds = 3;

/// Total length in edges of the curves connected to each curve.
IdVector<CurveId, double> piece_lengths(const CornerEnds& ends, std::size_t num_corners,
                                        const IdVector<CurveId, double>& num_edges,
                                        const IdVector<CurveId, char>& is_banned) {
  UnionFind corners(num_corners);
  for (CurveId c : num_edges.ids())
    if (!is_banned[c] && ends.curve_to_corners[c][0] >= 0)
      corners.unite(ends.curve_to_corners[c][0], ends.curve_to_corners[c][1]);
  std::vector<double> total(num_corners, 0.0);
  const auto root = [&](CurveId c) {
    return static_cast<std::size_t>(corners.find(ends.curve_to_corners[c][0]));
  };
  for (CurveId c : num_edges.ids())
    if (!is_banned[c] && ends.curve_to_corners[c][0] >= 0) total[root(c)] += num_edges[c];
  IdVector<CurveId, double> pieces = num_edges;
  for (CurveId c : num_edges.ids())
    if (!is_banned[c] && ends.curve_to_corners[c][0] >= 0) pieces[c] = total[root(c)];
  return pieces;
}

}  // namespace

double mean_edge_length(const BoundaryQuads& boundary, const std::vector<TubeVert>& tube) {
  double sum = 0;
  for (const TubeVert& t : tube) sum += boundary.edge_length[t.vert];
  return tube.empty() ? 0 : sum / static_cast<double>(tube.size());
}

IdVector<CurveId, char> ban_short_curves(const BoundaryQuads& boundary,
                                         const FeatureGraph& features,
                                         const IdVector<CurveId, std::vector<TubeVert>>& tubes,
                                         double min_edges, IdVector<CurveId, char>& is_banned) {
  IdVector<CurveId, char> is_short(features.curves.size(), 0);
  IdVector<CurveId, double> num_edges(features.curves.size(), 0.0);
  for (CurveId c : features.curves.ids()) {
    const double h = mean_edge_length(boundary, tubes[c]);
    if (h > 0) num_edges[c] = features.curves[c].length() / h;
  }
  for (int round = 0; round < kRounds; ++round) {
    const CornerEnds ends = find_corner_ends(features, is_banned);
    const auto pieces = piece_lengths(ends, features.corners.size(), num_edges, is_banned);
    bool any = false;
    for (CurveId c : features.curves.ids()) {
      if (is_banned[c]) continue;
      const auto& corners = ends.curve_to_corners[c];
      const bool dangles = std::any_of(corners.begin(), corners.end(), [&](int k) {
        return k >= 0 && ends.degree[static_cast<std::size_t>(k)] == 1;
      });
      if (pieces[c] >= min_edges && !(dangles && num_edges[c] < min_edges)) continue;
      is_short[c] = 1;
      any = true;
    }
    for (CurveId c : is_short.ids()) is_banned[c] |= is_short[c];
    if (!any) break;
  }
  return is_short;
}

}  // namespace hexwright::fitting
