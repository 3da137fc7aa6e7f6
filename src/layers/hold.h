// How the vertices of a mesh's boundary may move while its inside is relaxed.
#pragma once

#include "relax/state/fit_state.h"

namespace hexwright::layers {

/// Sets kind, move and axis: vertices of a plane stay in it, those of a straight edge on it,
/// corners and bent edges where they are; with region tags labelled quads stay too. Returns who is
/// on a curved patch instead (1 per vertex): to be held by targets.
IdVector<VertId, char> hold_boundary(relax::FitState& state);

}  // namespace hexwright::layers
