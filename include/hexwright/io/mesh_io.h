// Reads and writes hex and tet meshes: MEDIT .mesh, legacy VTK (ascii, binary), VTU (ascii, binary,
// appended, compressed). Hex vertex order in files is the format's own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/mesh/tet_mesh.h"

namespace hexwright {

/// One value per hex, written as cell data by formats that have it.
struct HexField {
  std::string name;
  std::vector<double> values;
};

/// Hexes of any program's file; other elements are counted and left out, boundary quads, edges and
/// corners become labels. Throws Error{CannotOpen} or Error{BadFile}.
HexMesh read_hex_mesh(const std::filesystem::path& path);
TetMesh read_tet_mesh(const std::filesystem::path& path);

struct WriteHexOptions {
  std::vector<HexField> fields;
  bool write_sets = false;  ///< VTU, VTK: also quads, edges and corners as cells (they are always
                            ///< in the field data)
};

/// Writes by extension: .vtu, .vtk, .mesh, .msh (Gmsh 4.1), .inp (Abaqus C3D8). Whole or not at all
/// (written aside, renamed).
void write_hex_mesh(const std::filesystem::path& path, const HexMesh& mesh,
                    const WriteHexOptions& options = {});

/// Extensions write_hex_mesh accepts, with the dot; for messages.
const std::vector<std::string>& hex_mesh_extensions();

}  // namespace hexwright
