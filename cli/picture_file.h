// A picture of a mesh: a cut through the volume, coloured by scaled Jacobian.
#pragma once

#include <string>

#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/render/picture.h"

namespace hexwright::cli {

/// Cuts at the middle, across the box's second longest axis, and looks at the cut from aslant.
PictureOptions make_default_view(const HexMesh& mesh);

/// Looks at the face of a cut perpendicular to an axis; `offset` is its place in [0, 1].
PictureOptions make_cut_view(int axis, double offset);

void write_picture(const std::string& path, const HexMesh& mesh, const PictureOptions& options);

}  // namespace hexwright::cli
