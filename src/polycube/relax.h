// Optimises a mapped mesh on the object: untangles it, then improves it, with boundary vertices on
// the faces, edges and corners of the polycube's image.
#pragma once

#include "hexwright/base/context.h"

#include "polycube/map_back.h"

namespace hexwright::polycube {

/// Labels the boundary (patch = chart, curves, corners) and moves vertices; never inverts a hex
/// that is not inverted. `pad`: one layer of hexes is put under the boundary.
void relax(MappedMesh& mapped, const ObjectFeatures& object, const Lattice& lattice, bool pad,
           const Context& context);

}  // namespace hexwright::polycube
