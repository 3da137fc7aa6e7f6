// Which patch each face of a hex lies on.
#pragma once

#include <vector>

#include "hexwright/mesh/hex_adjacency.h"

namespace hexwright {

/// Place of a face in lists with 6 entries per hex.
inline std::size_t face_slot(const HexFace& face) {
  return 6 * face.hex.index() + static_cast<std::size_t>(face.lf);
}

/// By face_slot; invalid without a label. A labelled quad inside the mesh gives both its faces its
/// patch. Empty when no quad has a patch.
std::vector<PatchId> find_face_patches(const HexMesh& mesh);

}  // namespace hexwright
