// How the MFEM library numbers the faces of hexes.
#pragma once

#include <array>

#include "hexwright/mesh/hex_adjacency.h"

namespace hexwright::io {

/// Local faces in the library's order.
inline constexpr std::array<int, 6> kMfemFaces = {4, 2, 1, 3, 0, 5};

/// The number of each local face: faces are numbered as hexes first name them. Requires a mesh
/// whose faces have two hexes at most.
inline IdVector<HexId, std::array<std::size_t, 6>> number_mfem_faces(
    const HexNeighbors& neighbors) {
  IdVector<HexId, std::array<std::size_t, 6>> numbers(neighbors.neighbor.size());
  std::size_t next = 0;
  for (HexId h : numbers.ids())
    for (const int lf : kMfemFaces) {
      const auto l = static_cast<std::size_t>(lf);
      const HexId other = neighbors.neighbor[h][l];
      if (!other.is_valid() || other > h) {
        numbers[h][l] = next++;
        continue;
      }
      for (std::size_t k = 0; k < 6; ++k)
        if (neighbors.neighbor[other][k] == h) numbers[h][l] = numbers[other][k];
    }
  return numbers;
}

}  // namespace hexwright::io
