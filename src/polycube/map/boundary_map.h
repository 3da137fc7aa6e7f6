// The map restricted to the polycube's boundary: from a point on a face of the polycube to the
// object's surface.
#pragma once

#include "hexwright/geometry/surface_tree.h"

#include "polycube/lattice/lattice.h"

namespace hexwright::polycube {

/// The six directions a face can look in: 2 * axis + (up the axis).
class BoundaryMap {
 public:
  explicit BoundaryMap(const Lattice& lattice);

  /// A point of a boundary facet, in lattice units.
  struct Hit {
    TriId facet;
    Vec3 point;
  };
  /// The nearest among the facets of one direction, so that a query beside an edge of the polycube
  /// cannot cross it. Requires the polycube to have facets of that direction.
  Hit closest(const Vec3& p, int direction) const;

  /// The hit's place on the object, by barycentric coordinates in the facet.
  Vec3 carry(const TetMesh& object, const Hit& hit) const;

  int direction_of(TriId facet) const;

 private:
  const Lattice& lattice_;
  std::array<std::vector<TriId>, 6> facets_;
  std::vector<SurfaceTree> trees_;  // per direction
};

}  // namespace hexwright::polycube
