// Reads triangle surfaces: OBJ, OFF, STL (ascii, binary), PLY (ascii, binary). By content first,
// extension second.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

struct SurfaceFile {
  TriMesh mesh;                       ///< polygons are triangulated; nothing is welded or dropped
  std::string format;                 ///< "OBJ", "STL (binary)" ...
  std::vector<std::string> warnings;  ///< "count field says 1446 facets, file holds 446" ...
};

/// Throws Error{CannotOpen} or Error{BadFile}; `where` names the file and line or element, the
/// message the remedy.
SurfaceFile read_surface(const std::filesystem::path& path);

/// Writes OBJ, OFF, binary STL or binary PLY by extension; the file appears whole or not at all.
void write_surface(const std::filesystem::path& path, const TriMesh& surface);

}  // namespace hexwright
