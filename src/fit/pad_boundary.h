// One layer of hexes under the whole boundary.
#pragma once

#include "fit/fit_state.h"

namespace hexwright::fitting {

/// The boundary's vertices stay; the hexes behind it take copies of them. Faces that lie in the
/// fixed outer box get no layer. Throws Error{BadGeometry} when no layer, however thin, has
/// positive corner determinants everywhere (cannot happen on what carve keeps). Rebuilds the state.
void pad_boundary(FitState& state);

}  // namespace hexwright::fitting
