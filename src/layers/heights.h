// How high the sheet is to stand over each vertex of a wall.
#pragma once

#include "layers/sheet.h"

namespace hexwright::layers {

/// Sets wish, height and limit of the sheet's vertices: the wish, at most a share of the way to
/// what faces the wall and a multiple of the edges here, made smooth from below.
void set_heights(SheetMesh& sheet, const Target& target, const LayersOptions& options);

/// Neighbours along the walls' edges of each of the sheet's vertices, as indices into its verts.
std::vector<std::vector<std::size_t>> find_sheet_neighbors(const SheetMesh& sheet);

/// Lowers heights until none is higher than a neighbour's by more than a share of the edge between
/// them; what a neighbour lowers has the neighbour's reason.
void smooth_from_below(SheetMesh& sheet, const std::vector<std::vector<std::size_t>>& neighbors);

}  // namespace hexwright::layers
