// How convex and how sharp the surface is along each feature curve.
#pragma once

#include "hexwright/geometry/feature_graph.h"

namespace hexwright::fitting {

/// Per curve: the share of its length, among edges with two triangles, where the outward side is
/// convex; 0 when there is no such edge. Seen from the other side, a share s is 1 - s.
IdVector<CurveId, double> compute_convex_shares(const TriMesh& surface,
                                                const FeatureGraph& features);

/// Per curve: the mean angle between the two triangles at its edges, on whichever side it is less
/// than pi, weighted by length, radians: pi where the surface is flat, near 0 along a knife's edge;
/// pi too when no edge has two triangles.
IdVector<CurveId, double> compute_wedge_angles(const TriMesh& surface,
                                               const FeatureGraph& features);

}  // namespace hexwright::fitting
