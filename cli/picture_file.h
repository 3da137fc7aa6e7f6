// Pictures as files.
#pragma once

#include <string>

#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/render/picture.h"

namespace hexwright::cli {

void write_picture(const std::string& path, const HexMesh& mesh, const PictureOptions& options);

}  // namespace hexwright::cli
