// From where a sheet's vertices see all of its faces, and room for the sheet where none does.
#pragma once

#include "fit/carve/visible_normal.h"
#include "fit/sheets/sheet.h"
#include "relax/state/fit_state.h"

namespace hexwright::fitting {

using relax::FitState;

/// Per vertex of the sheet: the direction that sees its faces there best.
std::vector<VisibleDirection> find_visible_directions(const HexMesh& mesh, const Sheet& sheet);

/// Moves those of the sheet's vertices `verts` from which no direction d has n . d >=
/// `least_cosine` for the normals n of all its faces there, each to where one does if such a place
/// is near, while the hexes around stay valid and the sheet's other vertices are seen no worse than
/// enough. Changes positions only.
void make_visible(FitState& state, const Sheet& sheet, std::span<const VertId> verts,
                  double least_cosine);

}  // namespace hexwright::fitting
