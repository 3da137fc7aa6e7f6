// A padding sheet under a set of regions that ends on the curves around it.
#pragma once

#include "fit/sheets/feature_layers.h"

namespace hexwright::fitting {

using relax::FitState;

/// Which sheet each region belongs to; sheets are numbered from 0.
struct SheetChoice {
  static constexpr int kNone = -1;
  IdVector<RegionId, int> region_to_sheet;
  std::size_t num_sheets = 0;
};

/// Inserts many sheets with one rebuild of the state. Quads of different sheets share no vertex.
/// Each splits the quad vertices of its regions: the originals stay on the boundary, the hexes
/// behind get copies, one new hex per quad. A sheet's own boundary faces, over the border curves,
/// become quads of the neighbouring regions. Returns per sheet 1 when it went in, 0 where its rim
/// cannot pass a vertex, no direction sees the quads at a vertex, or no offset gives valid hexes.
std::vector<char> extrude_regions(FitState& state, FeatureMarks& marks,
                                  const FeatureGraph& features, const SheetChoice& choice);

/// Sheets around sets of hexes. A sheet covers its set where the set has chosen boundary quads and
/// towards the other hexes; the set's other boundary quads stay on the boundary.
struct WrapChoice {
  IdVector<HexId, int> hex_to_sheet;    ///< sets of different sheets share no vertex
  IdVector<QuadId, int> quad_to_sheet;  ///< chosen quads of the sets; SheetChoice::kNone elsewhere
  std::size_t num_sheets = 0;
};

struct WrapOutcome {
  std::vector<char> is_done;    ///< per sheet
  std::vector<VertId> blocked;  ///< ascending: vertices that sheets could not pass
};

/// As extrude_regions: the hexes of a set get copies, the others and chosen quads the originals.
WrapOutcome wrap_hexes(FitState& state, FeatureMarks& marks, const FeatureGraph& features,
                       const WrapChoice& choice);

}  // namespace hexwright::fitting
