// Writing results.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "hexwright/io/mesh_io.h"

#include "console.h"

namespace hexwright::cli {

/// Finds before the work what would fail or destroy something after it. Empty paths are options
/// that were not given. Throws Error{CannotOpen} when one of the outputs cannot be written, and
/// Error{BadArgument} when two of them are the same file, or one is among `inputs`. (Commands that
/// may work in place pass no inputs: files are replaced whole.)
void check_outputs(std::initializer_list<std::string> outputs,
                   std::initializer_list<std::string> inputs = {});

/// Which elements a hex mesh is written with: WriteHexOptions::format and nodes_per_hex.
struct ElementChoice {
  std::string format;
  int nodes_per_hex = 0;
};

/// Writes a hex mesh with the scaled Jacobian of each hex as a field and with further `fields`, in
/// the format of that name or, when it is empty, by the extension. Warns of names that the format
/// could not take, and returns them.
std::vector<ChangedName> write_mesh_with_quality(const std::string& path, const HexMesh& mesh,
                                                 Console& console, const ElementChoice& choice = {},
                                                 const std::vector<HexField>& fields = {});

/// The same without the field.
std::vector<ChangedName> write_mesh(const std::string& path, const HexMesh& mesh, Console& console,
                                    const WriteHexOptions& options);

/// A cut through the mesh as PNG; nothing for an empty path.
void write_cut_picture(const std::string& path, const HexMesh& mesh);

}  // namespace hexwright::cli
