// The names of a surface's parts, carried through its preparation.
#pragma once

#include "hexwright/geometry/prepare_surface.h"

namespace hexwright {

/// Gives every triangle the group of its source. Triangles that close a hole get the group that
/// most of the hole's border has where several meet there, so that a gap between two groups leaves
/// one border; else none (-1), so that a cap is a patch of its own where its rim is sharp.
void carry_groups(const TriMesh& input, PreparedSurface& prepared);

}  // namespace hexwright
