// Reads and writes hex and tet meshes: VTU, legacy VTK, MEDIT, Gmsh, Abaqus, and for writing also
// the formats of OpenFOAM, MFEM, Exodus II, Nastran, Ansys, LS-DYNA, SU2, CGNS, MED and VTKHDF
// (docs/format.md). Hex vertex order in files is the format's own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hexwright/io/set_table.h"
#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/mesh/tet_mesh.h"

namespace hexwright {

/// One value per hex, written as cell data by formats that have it.
struct HexField {
  std::string name;  ///< without blanks, quotes and slashes; not "region", which files have already
  std::vector<double> values;
};

/// Hexes of any program's file, of first or second order; other elements are counted and left out,
/// boundary quads, edges and corners become labels. Throws Error{CannotOpen} or Error{BadFile}.
HexMesh read_hex_mesh(const std::filesystem::path& path);
/// Tets of any program's file; a file of hexes alone is cut_hexes(). Throws as above.
TetMesh read_tet_mesh(const std::filesystem::path& path);

/// MEDIT, or legacy VTK for names that end in .vtk. Whole or not at all. Throws Error{BadArgument}
/// for other extensions.
void write_tet_mesh(const std::filesystem::path& path, const TetMesh& mesh);

struct WriteHexOptions {
  std::vector<HexField> fields;
  bool write_sets = false;  ///< VTU, VTK: also quads, edges and corners as cells (they are always
                            ///< in the field data)
  bool names_by_place = false;  ///< patches without a name get one by name_by_place()
  /// Of a mesh with mid-nodes: 20, 27, 8 to leave them out, 0 for what is usual in the format.
  int nodes_per_hex = 0;
  std::string format;  ///< one of hex_mesh_formats(), or empty: by the name's extension
};

struct WriteHexResult {
  std::vector<ChangedName> changed_names;  ///< of sets whose names the format could not take
};

/// Writes in the format that `options` name, else by extension. Whole or not at all (written aside,
/// renamed). An OpenFOAM mesh is a folder, by its name `polyMesh`.
WriteHexResult write_hex_mesh(const std::filesystem::path& path, const HexMesh& mesh,
                              const WriteHexOptions& options = {});

/// Extensions write_hex_mesh accepts, with the dot; for messages.
const std::vector<std::string>& hex_mesh_extensions();
/// What WriteHexOptions::format may be: "vtu", "gmsh2", "openfoam" ...
const std::vector<std::string>& hex_mesh_formats();
/// Throws Error{BadArgument}, which lists what there is, when write_hex_mesh would not know the
/// format, or when that has no hexes of this order or, for order 2, with so many nodes (0: any).
void check_hex_mesh_format(const std::filesystem::path& path, const std::string& format,
                           int order = 1, int nodes_per_hex = 0);

}  // namespace hexwright
