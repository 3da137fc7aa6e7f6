// Inserts a sheet into a mesh: its quads are doubled and the gap filled with one hex per quad.
//
// Based on: Mitchell, Tautges, "Pillowing doublets: refining a mesh to ensure that faces share at
// most one edge", 4th International Meshing Roundtable, 1995.
#pragma once

#include "fit/sheets/sheet.h"

namespace hexwright::fitting {

struct Insertion {
  std::vector<VertId> copies;  ///< one per sheet vertex; empty when the insertion failed
  /// Of a failed insertion: the sheet's vertices, ascending, at hexes that no offset made good.
  std::vector<VertId> stuck;
};

/// Moves copies of the sheet's vertices against their directions and adds the hexes between, in
/// order of the quads. Offsets shrink until every corner of the hexes touched is clearly positive.
/// When that fails the mesh is left unchanged.
Insertion insert_sheet(HexMesh& mesh, const VertToHex& vert_to_hex, const SheetPlan& plan);

}  // namespace hexwright::fitting
