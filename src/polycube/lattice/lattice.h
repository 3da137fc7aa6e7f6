// The polycube's integer lattice: its axis-aligned boundary planes snapped to integers, and the
// cubes inside.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "hexwright/grid/grid.h"
#include "hexwright/mesh/tet_mesh.h"

#include "polycube/lattice/axis_scales.h"

namespace hexwright::polycube {

/// A connected part of the boundary whose facets face one of the six axis directions.
struct Chart {
  int axis = 0;
  int sign = 1;           ///< +1 when it faces up the axis
  double coordinate = 0;  ///< area-weighted mean along the axis, in the input's units
  int plane = 0;          ///< integer coordinate on the lattice
};

struct Lattice {
  TetMesh tets;  ///< the polycube moved to lattice units, boundary vertices exactly on planes
  IdVector<TriId, std::array<VertId, 3>> facets;  ///< the boundary, outward
  IdVector<TriId, int> facet_to_chart;
  std::vector<Chart> charts;
  std::vector<LatticeCoord> roots;  ///< unit cubes inside, sorted (z, y, x)
  double spacing = 0;
  double max_deviation = 0;           ///< of a vertex from its chart's plane, share of the spacing
  std::size_t num_merged_charts = 0;  ///< too small for the lattice, given to a neighbour
  std::size_t num_unaligned = 0;      ///< facets that face no axis but are too small to matter
};

struct Faces;

/// Lays the faces' polycube on the integer lattice; `spacing` is what the report calls its unit.
/// Errors: BadGeometry when no cube lies inside, BadArgument when one side has over 1000 cubes,
/// OutOfResources when more than `max_roots` lie inside.
Lattice place_on_lattice(const Faces& faces, const AxisScales& scales, double spacing,
                         std::size_t max_roots);

}  // namespace hexwright::polycube
