// Lines that show a mesh's shape, to be drawn bolder than those that show its hexes.
#pragma once

#include <vector>

#include "render/visible_faces.h"

namespace hexwright {

/// Sets `bold_sides` of visible faces: along the mesh's labelled edges, or without any where two
/// boundary faces meet at more than 40 degrees, and round what a cut lays open.
void mark_creases(const HexMesh& mesh, std::vector<VisibleFace>& faces);

}  // namespace hexwright
