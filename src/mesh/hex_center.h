// The middle of a hex.
#pragma once

#include "hexwright/mesh/hex_mesh.h"

namespace hexwright {

/// The mean of its corners.
inline Vec3 center_of(const HexMesh& mesh, HexId h) {
  Vec3 center;
  for (const Vec3& p : mesh.corners(h)) center += p / 8;
  return center;
}

}  // namespace hexwright
