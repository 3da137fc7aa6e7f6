// The boundary vertices around a curve: the only ones its path may use.
#pragma once

#include <vector>

#include "hexwright/geometry/feature_graph.h"

#include "fit/curves/vert_reach.h"

namespace hexwright::fitting {

using relax::BoundaryQuads;

struct TubeVert {
  VertId vert;
  double distance = 0;  ///< to the curve, in edge lengths of the vertex
  double arc = 0;       ///< of the nearest point on the curve
};

/// Ascending by vertex. `reach_tree` must have at least the reach asked for.
std::vector<TubeVert> compute_tube(const BoundaryQuads& boundary, const VertReach& reach_tree,
                                   const TriMesh& surface, const FeatureCurve& curve, double reach);

}  // namespace hexwright::fitting
