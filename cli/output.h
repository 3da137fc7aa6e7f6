// Writing results.
#pragma once

#include <initializer_list>
#include <string>

#include "hexwright/mesh/hex_mesh.h"

namespace hexwright::cli {

/// Throws Error{CannotOpen} when one of the (non-empty) paths cannot be written: better now than
/// after the work.
void check_outputs(std::initializer_list<std::string> paths);

/// Writes a hex mesh with the scaled Jacobian of each hex as a field.
void write_mesh_with_quality(const std::string& path, const HexMesh& mesh);

}  // namespace hexwright::cli
