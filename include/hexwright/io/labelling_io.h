// Reads polycube labellings: for each triangle of a surface, the direction it shall face.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace hexwright {

/// Whole numbers 0 to 5, for +x, -x, +y, -y, +z, -z, one per triangle in the order of the surface's
/// file, separated by blanks or line ends; `#` starts a comment. This is what evocube,
/// validity-first-polycube-labeling and robustPolycube write (`surface_labeling.txt`).
/// Throws Error{CannotOpen}; Error{BadFile} with the line when a word is no such number, or when
/// there are not `num_triangles` of them.
std::vector<std::uint8_t> read_labelling(const std::filesystem::path& path,
                                         std::size_t num_triangles);

}  // namespace hexwright
