// Inserts a sheet of hexes: a set of quads is doubled and the gap filled with one hex per quad.
//
// Based on: Mitchell, Tautges, "Pillowing doublets: refining a mesh to ensure that faces share at
// most one edge", 4th International Meshing Roundtable, 1995.
#pragma once

#include <span>
#include <vector>

#include "hexwright/mesh/hex_adjacency.h"

namespace hexwright::fitting {

struct Sheet {
  /// Seen from the side that keeps the quads' vertices, counter-clockwise; the hexes behind get the
  /// copies.
  std::vector<std::array<VertId, 4>> quads;
  std::vector<HexId> behind;     ///< per quad: the hex behind, whose region tag the new one gets
  std::vector<VertId> verts;     ///< of the quads, ascending
  std::vector<Vec3> directions;  ///< per vertex: unit, sees all its quads from in front
  double depth = 0.3;            ///< first offset, in shortest incident edges
};

/// Vertices of a sheet's quads, ascending.
std::vector<VertId> sheet_verts(const std::vector<std::array<VertId, 4>>& quads);

struct SheetInsertion {
  std::vector<VertId> copies;  ///< one per sheet vertex; empty when the insertion failed
  /// Of a failed insertion: the sheet's vertices, ascending, at hexes that no offset made good.
  std::vector<VertId> stuck;
};

/// Moves copies of the sheet's vertices against their directions and adds the hexes between, in
/// order of the quads. `takes_copy` says per hex of the mesh whether it is behind; empty: all are.
/// Offsets shrink until every corner of the hexes touched has a scaled Jacobian above
/// `min_jacobian`. When that fails the mesh is left unchanged.
SheetInsertion insert_sheet(HexMesh& mesh, const VertToHex& vert_to_hex, const Sheet& sheet,
                            std::span<const char> takes_copy, double min_jacobian);

}  // namespace hexwright::fitting
