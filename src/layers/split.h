// From one layer of hexes to all of them.
#pragma once

#include "layers/sheet.h"

namespace hexwright::layers {

struct SplitMesh {
  HexMesh mesh;
  IdVector<HexId, std::int32_t> layer;  ///< 0, or counted from the wall
};

/// Splits the sheet's hexes along its edges by the specs' ratios. Other hexes come first, in their
/// order; labels on the sheet's rims are split with it.
SplitMesh split_sheet(const SheetMesh& sheet, const LayersOptions& options);

}  // namespace hexwright::layers
