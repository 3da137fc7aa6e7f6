// Writing results.
#pragma once

#include <initializer_list>
#include <string>

#include "hexwright/mesh/hex_mesh.h"

namespace hexwright::cli {

/// Finds before the work what would fail or destroy something after it. Empty paths are options
/// that were not given. Throws Error{CannotOpen} when one of the outputs cannot be written, and
/// Error{BadArgument} when two of them are the same file, or one is among `inputs`. (Commands that
/// may work in place pass no inputs: files are replaced whole.)
void check_outputs(std::initializer_list<std::string> outputs,
                   std::initializer_list<std::string> inputs = {});

/// Writes a hex mesh with the scaled Jacobian of each hex as a field.
void write_mesh_with_quality(const std::string& path, const HexMesh& mesh);

}  // namespace hexwright::cli
