// A hex mesh as a conforming tet mesh.
#pragma once

#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/mesh/tet_mesh.h"

namespace hexwright {

inline constexpr std::size_t kTetsPerHex = 24;

/// Cuts every hex into 24 tets around its centre and those of its faces (means of their corners):
/// hex h becomes tets 24 h .. 24 h + 23. No diagonal is chosen, so meshes of the same hexes are cut
/// alike wherever their vertices are. Vertices keep their ids; centres of faces follow in order of
/// the first (hex, face) that has them, then those of hexes.
TetMesh cut_hexes(const HexMesh& mesh);

}  // namespace hexwright
