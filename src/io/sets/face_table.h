// The faces of hexes, found by their vertices.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "hexwright/mesh/hex_adjacency.h"

namespace hexwright::io {

using Hexes = IdVector<HexId, std::array<VertId, 8>>;

/// The four vertices of a face, counter-clockwise seen from outside the hex.
std::array<VertId, 4> face_verts(const Hexes& hexes, HexFace face);

class FaceTable {
 public:
  explicit FaceTable(const Hexes& hexes);

  struct Found {
    HexFace face;  ///< the first in (hex, lf) order
    bool is_inner = false;
  };
  /// The face that has these vertices, in any order; absent when there is none.
  std::optional<Found> find(const std::array<VertId, 4>& verts) const;

 private:
  struct KeyedFace {
    std::array<VertId, 4> key;  ///< increasing
    HexFace face;
  };
  std::vector<KeyedFace> faces_;  // by key, then by hex
};

}  // namespace hexwright::io
