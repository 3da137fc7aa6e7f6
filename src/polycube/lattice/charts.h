// The faces of a polycube: which parts of a tet mesh's boundary look along which axis, and in which
// planes they lie.
#pragma once

#include "polycube/lattice/axis_scales.h"
#include "polycube/lattice/lattice.h"

namespace hexwright::polycube {

struct Faces {
  Lattice lattice;  ///< facets and charts, without their planes; tets still in the input's units,
                    ///< boundary vertices on their planes
  AxisPlanes planes;
  std::vector<std::size_t> chart_plane;  ///< per chart: the number of its plane among its axis's
  double extent = 0;                     ///< longest edge of the bounding box
};

/// `spacing` (0: the least distance of two planes) says how small a chart may be that is kept.
/// Boundary vertices up to a quarter of the way to the next plane, or 2% of the extent, off their
/// chart's plane are put on it. Errors: BadGeometry naming the facet that is not axis-aligned or is
/// farther off its plane.
Faces find_faces(const TetMesh& polycube, double spacing);

}  // namespace hexwright::polycube
