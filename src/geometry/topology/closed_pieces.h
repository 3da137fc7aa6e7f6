// The closed pieces of a surface: watertight, consistently oriented two-manifolds, taken apart
// where they share edges or vertices.
#pragma once

#include <vector>

#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

/// A closed piece with vertices of its own: one per fan of triangles.
struct ClosedPiece {
  TriMesh mesh;
  std::vector<TriId> tri_to_surface;
  std::vector<VertId> vert_to_surface;
  Box3 box;
  double volume = 0;  ///< negative: its normals point inwards
};

/// Numbers the pieces by their first triangles. Triangles with an open side, or with neighbours of
/// the other orientation, belong to none. Where more than two triangles meet in an edge they are
/// paired across the solid between them, so that solids that touch along an edge come apart.
std::vector<ClosedPiece> split_closed_pieces(const TriMesh& surface);

}  // namespace hexwright
