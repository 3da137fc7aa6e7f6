// Pads several places of the boundary at once: under sets of quads, around sets of hexes.
#pragma once

#include "fit/curves/boundary_state.h"

namespace hexwright::fitting {

/// Which sheet covers what; sheets are numbered from 0 and share no vertex.
/// A sheet without hexes lies under its quads: whatever is behind them gets the copies.
/// A sheet around a set of hexes covers it towards the other hexes and where it has chosen boundary
/// quads; the set gets the copies, and its other boundary quads go with it.
struct SheetSets {
  static constexpr int kNone = -1;
  IdVector<QuadId, int> quad_to_sheet;  ///< covered quads; kNone elsewhere
  IdVector<HexId, int> hex_to_sheet;    ///< kNone: in no set; empty: no sheet has a set
  std::size_t num_sheets = 0;
};

struct PadOutcome {
  std::vector<char> is_done;    ///< per sheet: 1 when it went in
  std::vector<VertId> blocked;  ///< ascending: vertices that sheets could not pass
};

/// Inserts the sheets with one rebuild of the state. Covered quads keep their vertices; over a
/// sheet's rim its hexes become quads of the neighbouring regions. A sheet is left out where its
/// rim cannot pass a vertex, no direction sees its quads at one, or no offset gives valid hexes.
PadOutcome pad(FitState& state, BoundaryState& boundary, const FeatureGraph& features,
               const SheetSets& sets);

}  // namespace hexwright::fitting
