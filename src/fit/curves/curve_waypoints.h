// Arcs a path must pass so that it follows its curve instead of cutting it short.
#pragma once

#include <vector>

#include "hexwright/geometry/feature_graph.h"

namespace hexwright::fitting {

/// Arcs from 0 to the curve's length such that between two of them the curve is nearly as short as
/// its chord, or only a few edges long. A loop has at least two inside.
std::vector<double> find_waypoint_arcs(const TriMesh& surface, const FeatureCurve& curve,
                                       double edge_length);

}  // namespace hexwright::fitting
