// Surfaces as a whole: what they enclose, how large they are, and several made into one.
#pragma once

#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

/// The volume within a closed surface, negative when its normals point inwards. Summed from a point
/// of the surface, so that far from the origin nothing cancels.
double enclosed_volume(const TriMesh& surface);

double total_area(const TriMesh& surface);

/// Adds the vertices and triangles of `from` behind those of `to`, unwelded. Groups stay behind.
void append(TriMesh& to, const TriMesh& from);

}  // namespace hexwright
