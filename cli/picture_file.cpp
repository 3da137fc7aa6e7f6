// Pictures as files.
#include "picture_file.h"

namespace hexwright::cli {

void write_picture(const std::string& path, const HexMesh& mesh, const PictureOptions& options) {
  write_png(path, render_hex_mesh(mesh, options));
}

}  // namespace hexwright::cli
