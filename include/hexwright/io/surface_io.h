// Reads triangle surfaces: OBJ, OFF, STL and PLY (text and binary), polygons of VTK, shells of Gmsh
// and Nastran, 3MF. By content first, extension second.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

struct SurfaceFile {
  /// Polygons are triangulated; nothing is welded or dropped. Solids of STL, groups (or materials,
  /// or objects) of OBJ, the face property patch, label, group or material of PLY and VTK, physical
  /// groups of Gmsh, properties of Nastran and objects of 3MF are its groups.
  TriMesh mesh;
  std::string format;                 ///< "OBJ", "STL (binary)" ...
  std::vector<std::string> warnings;  ///< "count field says 1446 facets, file holds 446" ...
};

/// Throws Error{CannotOpen} or Error{BadFile}; `where` names the file and line or element, the
/// message the remedy.
SurfaceFile read_surface(const std::filesystem::path& path);

/// Writes OBJ, OFF, STL or binary PLY by extension; the file appears whole or not at all. STL is
/// binary, or text when the surface has named groups; OFF loses them.
void write_surface(const std::filesystem::path& path, const TriMesh& surface);

}  // namespace hexwright
