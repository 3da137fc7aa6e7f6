// Lets the sheet grow from the walls to its heights, the inside of the mesh giving way.
#pragma once

#include "hexwright/base/context.h"

#include "layers/sheet.h"

namespace hexwright::layers {

/// Moves the sheet's inner vertices and everything inside, never inverting a hex: not a part of the
/// sheet either, once it is split. Heights that cannot be reached without are lowered, with the
/// reason Shape. Vertices of walls stay; those of other patches move on the surface. Returns the
/// vertices of walls where layers are inverted all the same: their walls can have none.
std::vector<VertId> grow_sheet(SheetMesh& sheet, const Target& target, const LayersOptions& options,
                               const Context& context);

/// Height of the sheet at one of its vertices, as it stands.
double measure_height(const SheetMesh& sheet, const SheetVert& vert);

/// Least scaled Jacobian over the layers that a hex of the sheet becomes.
double layer_quality(const SheetMesh& sheet, const SheetHex& hex, const LayersOptions& options);

}  // namespace hexwright::layers
