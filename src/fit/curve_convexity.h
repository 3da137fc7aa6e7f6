// How convex the surface is along each feature curve.
#pragma once

#include "hexwright/geometry/feature_graph.h"

namespace hexwright::fitting {

/// Per curve: the share of its length, among edges with two triangles, where the outward side is
/// convex; 0 when there is no such edge. Seen from the other side, a share s is 1 - s.
IdVector<CurveId, double> compute_convex_shares(const TriMesh& surface,
                                                const FeatureGraph& features);

}  // namespace hexwright::fitting
