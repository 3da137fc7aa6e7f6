// Solids that nearly coincide, so that their union is full of slits: parts turned or rounded apart
// by a little where they were meant to touch.
#pragma once

#include <span>

#include "geometry/prepare/unite_solids.h"

namespace hexwright {

/// Share of the surface's area from which another wall that looks back is no farther than `width`
/// outside the solid.
double measure_slits(const TriMesh& surface, double width);

/// The union of the solids with gaps of up to about `width` between them closed: they grow by half
/// of it, and the union shrinks back by as much. Faces are single triangles. Empty when the union
/// could not be made.
UnitedSurface unite_closing_gaps(std::span<const Solid> solids, double width);

}  // namespace hexwright
