// Leaves out curves that are too short for the mesh around them.
#pragma once

#include <vector>

#include "fit/curves/curve_tube.h"
#include "fit/curves/match_corners.h"

namespace hexwright::fitting {

using relax::BoundaryQuads;

/// Marks in `is_banned` (one entry per curve) the curves that end freely, and connected sets of
/// curves, shorter than `min_edges` edges of the mesh around them. Three rounds: what remains may
/// end freely then. Returns which curves were marked here.
IdVector<CurveId, char> ban_short_curves(const BoundaryQuads& boundary,
                                         const FeatureGraph& features,
                                         const IdVector<CurveId, std::vector<TubeVert>>& tubes,
                                         double min_edges, IdVector<CurveId, char>& is_banned);

/// Mean edge length over a tube's vertices; 0 when it has none.
double mean_edge_length(const BoundaryQuads& boundary, const std::vector<TubeVert>& tube);

}  // namespace hexwright::fitting
