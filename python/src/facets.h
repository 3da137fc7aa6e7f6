// The labelled parts of a hex mesh's boundary, sorted so that each part is one piece of an array.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hexwright/mesh/hex_mesh.h"

namespace hexwright::python {

/// Elements by label: those of label k are start[k] .. start[k + 1]. Elements without a label come
/// last, from start.back() on.
template <std::size_t N>
struct LabelTable {
  std::vector<std::array<VertId, N>> verts;  ///< as labelled
  std::vector<std::size_t> start;
};

struct FacetTable {
  LabelTable<4> quads;            ///< by patch
  std::vector<HexId> owner;       ///< the hex that has the quad as a face
  std::vector<std::int8_t> side;  ///< which of its faces, as in hex_numbering.h
};

/// Of two hexes that share a quad, the owner is the one that sees it run as its own face does. -1
/// where no hex has the quad. Linear.
FacetTable sort_facets(const HexMesh& mesh);

/// Edges by curve.
LabelTable<2> sort_curves(const HexMesh& mesh);

}  // namespace hexwright::python
