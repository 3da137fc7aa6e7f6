// One layer of hexes along all quads that are to be fitted.
#pragma once

#include "fit/fit_state.h"

namespace hexwright::fitting {

/// The vertices of the quads to be fitted stay; the hexes behind them (on both sides with
/// Side::Both) take copies. Throws Error{BadGeometry} when no layer, however thin, has positive
/// corner determinants everywhere (cannot happen on what carve keeps). Rebuilds the state.
void pad_boundary(FitState& state);

}  // namespace hexwright::fitting
