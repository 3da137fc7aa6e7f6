// One layer of hexes along all quads that are to be fitted.
#pragma once

#include "relax/state/fit_state.h"

namespace hexwright::fitting {

using relax::FitState;

/// The vertices of the quads to be fitted stay; the hexes behind them (on both sides with
/// Side::Both) take copies. Rebuilds the state. False, with the side left as it was, when no layer,
/// however thin, has positive corner determinants everywhere: possible on foreign meshes, not on
/// what carve keeps.
bool pad_boundary(FitState& state);

}  // namespace hexwright::fitting
