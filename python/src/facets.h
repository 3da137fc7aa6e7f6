// The labelled parts of a hex mesh's boundary, sorted so that each part is one piece of an array.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hexwright/mesh/hex_mesh.h"

namespace hexwright::python {

/// Quads by patch: those of patch p are start[p] .. start[p + 1]. Quads without a patch come last,
/// from start.back() on.
struct FacetTable {
  std::vector<std::array<std::int32_t, 4>> quads;  ///< as labelled
  std::vector<std::int32_t> owner;                 ///< the hex that has the quad as a face
  std::vector<std::int8_t> side;                   ///< which of its faces, as in hex_numbering.h
  std::vector<std::size_t> start;
};

/// Of two hexes that share a quad, the owner is the one that sees it run as its own face does. -1
/// where no hex has the quad. Linear.
FacetTable sort_facets(const HexMesh& mesh);

/// Edges by curve, likewise.
struct CurveTable {
  std::vector<std::array<std::int32_t, 2>> edges;
  std::vector<std::size_t> start;
};
CurveTable sort_curves(const HexMesh& mesh);

}  // namespace hexwright::python
