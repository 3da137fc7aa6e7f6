// A padding sheet under a set of regions that ends on the curves around it.
#pragma once

#include "fit/feature_layers.h"

namespace hexwright::fitting {

/// Splits the quad vertices of the chosen regions: the originals stay on the boundary, the hexes
/// behind get copies, one new hex per quad. The sheet's own boundary faces, over the border curves,
/// become quads of the neighbouring regions. False, with nothing changed, where a rim cannot pass a
/// vertex, no direction sees the quads at a vertex, or no offset gives valid hexes.
bool extrude_regions(FitState& state, FeatureMarks& marks, const FeatureGraph& features,
                     const IdVector<RegionId, char>& is_chosen);

}  // namespace hexwright::fitting
