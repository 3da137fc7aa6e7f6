// Samples a polycube map adaptively: an object and a polycube as tetrahedral meshes of equal
// connectivity in, a hex mesh of the object out.
//
// Based on: Pitzalis, Livesu, Cherchi, Scateni, Gobbetti, "Generalized Adaptive Refinement for
// Grid-based Hexahedral Meshing", ACM TOG 40(6), 2021, section 6.2 (Figures 14 and 15).
#pragma once

#include <string>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/dual/dual_mesh.h"
#include "hexwright/fit/fit.h"
#include "hexwright/grid/complete.h"
#include "hexwright/mesh/tet_mesh.h"

namespace hexwright {

struct PolycubeOptions {
  double spacing =
      0;  ///< edge of a root cube in polycube units; 0 = derived from the closest two planes
  double max_stretch =
      1.0 /
      50;  ///< split while two object points of a cell are farther apart; share of the diagonal
  int min_level = 0, max_level = 6;
  std::size_t max_cells = 2'000'000;
  CompleteOptions complete;
};

struct PolycubeReport {
  std::size_t num_tets = 0, num_nonpositive_object = 0, num_nonpositive_polycube = 0;
  std::size_t num_charts = 0, num_unaligned_facets = 0;
  double max_plane_deviation =
      0;  ///< of a boundary vertex from its chart's plane, share of the spacing
  double spacing = 0;
  std::size_t num_roots = 0, num_sampled_cells = 0, num_cells = 0;
  std::size_t num_bridged =
      0;  ///< vertices located outside every positive tet, taken to the nearest
  std::size_t num_inverted_mapped = 0;  ///< hexes not positive right after mapping back
  std::vector<std::string> warnings;
};

struct PolycubeResult {
  HexMesh
      mesh;  ///< labels: patches are the polycube's faces, curves and corners its edges and corners
  Grid grid;        ///< on the polycube's integer lattice
  TriMesh surface;  ///< the object's boundary
  PolycubeReport report;
};

/// Errors: BadGeometry when the connectivities differ (names the tet), when the polycube's boundary
/// is not axis-aligned (names the facet) or encloses no lattice cube (asks for a smaller spacing);
/// OutOfResources past max_cells.
PolycubeResult mesh_polycube(const TetMesh& object, const TetMesh& polycube,
                             const PolycubeOptions& options, const Context& context);

}  // namespace hexwright
