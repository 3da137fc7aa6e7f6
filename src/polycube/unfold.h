// Foldover-free optimisation of a tetrahedral map.
//
// Based on: Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov, "Foldover-free maps in 50 lines
// of code", ACM TOG 40(4), 2021.
#pragma once

#include "hexwright/base/context.h"
#include "hexwright/mesh/tet_mesh.h"

namespace hexwright::polycube {

/// Moves vertices of `image` along their free axes (bit a of `free_axes`: axis a; 0 = fixed) until
/// every tet that has a free vertex is positive, or nothing more is gained; tets strive for the
/// shape they have in `object`. Requires equal connectivity and positive volume of `object`'s tets
/// (others are only kept positive). Returns the number of such tets that are not positive.
std::size_t unfold(const TetMesh& object, const IdVector<VertId, std::uint8_t>& free_axes,
                   TetMesh& image, const Context& context);

}  // namespace hexwright::polycube
