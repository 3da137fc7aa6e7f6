// Moves a mesh with some of its vertices, as far as nothing is inverted.
#pragma once

#include <vector>

#include "relax/state/fit_state.h"

namespace hexwright::layers {

/// Driven vertices (one entry per vertex) go `way`; the others follow by the harmonic extension of
/// the displacement over the mesh's edges, within what their `move` allows. Ways are shortened
/// around hexes whose scaled Jacobian would fall below a small floor and below what it was.
void displace(relax::FitState& state, const std::vector<char>& is_driven,
              IdVector<VertId, Vec3> way);

}  // namespace hexwright::layers
