// The boundary of a hex mesh as a surface of quads: its edges, vertices and components.
#pragma once

#include <array>
#include <vector>

#include "hexwright/mesh/hex_adjacency.h"

namespace hexwright {

struct BoundaryEdge {
  std::array<VertId, 2> verts;  ///< increasing
  std::size_t num_quads = 0;
};

struct BoundaryVert {
  VertId vert;
  std::size_t num_fans = 0;  ///< groups of its quads connected across edges with two quads
};

struct BoundarySurface {
  std::vector<HexFace> faces;                ///< in order of (hex, lf)
  std::vector<std::array<VertId, 4>> quads;  ///< of the faces, counter-clockwise from outside
  std::vector<BoundaryEdge> edges;           ///< sorted by vertices
  std::vector<BoundaryVert> verts;           ///< sorted
  std::size_t num_components = 0;            ///< connected across edges
};

BoundarySurface make_boundary_surface(const HexMesh& mesh, const HexNeighbors& adjacency);

}  // namespace hexwright
