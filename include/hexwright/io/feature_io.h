// Reads a user's own sharp features: edges that the mesh shall follow whatever their angle.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

/// The segments of a feature file, for FeatureOptions::extra_segments. Two forms, told apart by
/// their content: OBJ with `v` and `l` lines (polylines with their own coordinates; the surface's
/// own file when it holds `l` lines), or plain text with two vertices of `surface` per line,
/// counted from 0 in the order of the surface's file; '#' starts a comment. Throws
/// Error{CannotOpen} or Error{BadFile} naming the line and the remedy.
std::vector<std::array<Vec3, 2>> read_feature_edges(const std::filesystem::path& path,
                                                    const TriMesh& surface);

}  // namespace hexwright
