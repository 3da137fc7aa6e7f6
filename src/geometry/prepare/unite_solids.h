// The union of solids, exact but for rounding, with the origin of every triangle.
#pragma once

#include <span>
#include <vector>

#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

/// A closed, consistently oriented two-manifold; cavities are components that point inwards.
struct Solid {
  TriMesh mesh;
  /// Triangles that share a number and hang together in one plane are one face: it may be
  /// triangulated anew. The numbers are ids of triangles.
  IdVector<TriId, TriId> tri_to_face;
};

/// The surface of a union. Triangles lie in the faces they come from; vertices of the solids keep
/// their positions to the last bit.
struct UnitedSurface {
  TriMesh mesh;  ///< a closed, oriented two-manifold; empty when the union could not be made
  std::vector<int> tri_to_solid;
  std::vector<TriId> tri_to_face;  ///< of that solid
};

/// Faces that lie on each other are joined. The same result for any number of threads. Edges
/// shorter than `tolerance` may be collapsed.
UnitedSurface unite_solids(std::span<const Solid> solids, double tolerance);

}  // namespace hexwright
