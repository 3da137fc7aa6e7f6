// The exact shape of a CAD model, by points alone.
#pragma once

#include <memory>

#include "hexwright/cad/cad_model.h"
#include "hexwright/cad/cad_surface.h"

namespace hexwright {

/// Finds the face by the nearest triangle and the edge by the nearest polyline of `surface`'s
/// features, then projects exactly. Keeps what it needs of the model, its projector included.
std::shared_ptr<const ExactShape> make_exact_shape(const CadModel& model,
                                                   const CadSurface& surface);

}  // namespace hexwright
