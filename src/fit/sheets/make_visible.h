// Makes room for a sheet at vertices where no direction sees all of its faces.
#pragma once

#include "fit/sheets/insert_sheet.h"
#include "relax/fit_state.h"

namespace hexwright::fitting {

using relax::FitState;

/// Moves those of the sheet's vertices `verts` from which no direction d has n . d >=
/// `least_cosine` for the normals n of all its faces there, each to where one does if such a place
/// is near, while the hexes around stay valid and the sheet's other vertices are seen no worse than
/// enough. Changes positions only.
void make_visible(FitState& state, const Sheet& sheet, std::span<const VertId> verts,
                  double least_cosine);

}  // namespace hexwright::fitting
