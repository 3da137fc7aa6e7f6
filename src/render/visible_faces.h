// The faces of a hex mesh that a picture may show.
#pragma once

#include <vector>

#include "hexwright/mesh/hex_adjacency.h"
#include "hexwright/render/picture.h"

namespace hexwright {

struct VisibleFace {
  HexFace face;
  bool is_boundary = false;  ///< of the whole mesh, not only of what a cut leaves
};

/// Faces between a hex that the cut keeps and none, or one that it removes; in order of (hex, lf).
std::vector<VisibleFace> find_visible_faces(const HexMesh& mesh,
                                            const std::optional<PictureOptions::Cut>& cut);

}  // namespace hexwright
