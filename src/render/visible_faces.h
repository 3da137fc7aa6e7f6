// The faces of a hex mesh that a picture may show.
#pragma once

#include <cstdint>
#include <vector>

#include "hexwright/mesh/hex_adjacency.h"
#include "hexwright/render/picture.h"

namespace hexwright {

struct VisibleFace {
  HexFace face;
  bool is_boundary = false;     ///< of the whole mesh, not only of what a cut leaves
  bool is_focus = false;        ///< of the hex that the picture is about
  std::uint8_t bold_sides = 0;  ///< bits of sides to be drawn bold
};

/// Faces between a hex that the cut keeps and none, or one that it removes; in order of (hex, lf).
/// Pieces of a twentieth or less of what is kept, one hex thick along the cut, are removed too: a
/// plane close to a face of the mesh leaves such, and they hang in the air.
std::vector<VisibleFace> find_visible_faces(const HexMesh& mesh,
                                            const std::optional<PictureOptions::Cut>& cut);

/// The hex, what is around it (three steps by vertices), and nothing of that in front of it.
std::vector<VisibleFace> find_faces_about(const HexMesh& mesh, HexId focus,
                                          const Vec3& view_direction);

}  // namespace hexwright
