// Gives each corner of a surface a boundary vertex of its own.
#pragma once

#include <vector>

#include "hexwright/geometry/feature_graph.h"

#include "fit/curves/vert_reach.h"

namespace hexwright::fitting {

using relax::BoundaryGraph;
using relax::BoundaryQuads;

/// Which curves end at which corner.
struct CornerEnds {
  /// Per curve: index of the first and last corner in FeatureGraph::corners, -1 on a loop.
  IdVector<CurveId, std::array<int, 2>> curve_to_corners;
  std::vector<int> degree;  ///< per corner: ends of curves that are not banned
};
CornerEnds find_corner_ends(const FeatureGraph& features, const IdVector<CurveId, char>& is_banned);

/// How well a vertex suits a corner, lower is better: distance in edge lengths plus one per edge
/// that the vertex lacks.
double corner_cost(const BoundaryQuads& boundary, const BoundaryGraph& graph, VertId vert,
                   const Vec3& corner, int degree);

/// The best free vertex within `reach[k]` edge lengths of corner k, those of highest degree first;
/// invalid where there is none or the degree is 0.
std::vector<VertId> match_corners(const BoundaryQuads& boundary, const BoundaryGraph& graph,
                                  const VertReach& reach_tree, const TriMesh& surface,
                                  const FeatureGraph& features, const CornerEnds& ends,
                                  const std::vector<double>& reach);

}  // namespace hexwright::fitting
