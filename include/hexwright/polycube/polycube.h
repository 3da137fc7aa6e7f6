// Samples a polycube map adaptively: an object and a polycube as tetrahedral meshes of equal
// connectivity in, a hex mesh of the object out.
//
// Based on: Pitzalis, Livesu, Cherchi, Scateni, Gobbetti, "Generalized Adaptive Refinement for
// Grid-based Hexahedral Meshing", ACM TOG 40(6), 2021, section 6.2 (Figures 14 and 15).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/dual/dual_mesh.h"
#include "hexwright/fit/fit.h"
#include "hexwright/grid/complete.h"
#include "hexwright/mesh/tet_mesh.h"
#include "hexwright/quality/judge.h"

namespace hexwright {

struct PolycubeOptions {
  /// Edge of a root cube in polycube units, the same everywhere; 0 suits the lattice to the map:
  /// cubes are as large as the criteria below allow, up to the distance of the closest two planes,
  /// and denser where the object is long along an axis. Levels count from cubes of that distance.
  double spacing = 0;
  /// Split while a cell, mapped, is longer along an axis than this share of the diagonal, or two of
  /// the object's vertices in it are farther apart.
  double max_stretch = 1.0 / 50;
  /// Hexes wanted, about: max_stretch is then found from this, starting at its value, and the
  /// surface's distance is not asked for. 0 = off.
  std::size_t target_hexes = 0;
  /// Distance between the mesh and the object's surface, both ways, as a share of the diagonal:
  /// cells are split where it would be exceeded, and again where a finished mesh exceeds it. 0 =
  /// off.
  double max_surface_error = 0.003;
  /// Size field: the longest mean edge wanted around an object point, world units; empty = none.
  std::function<double(const Vec3&)> max_edge;
  int min_level = 0, max_level = 9;
  int max_rounds = 6;  ///< meshes made at most; more than one only where the surface was missed
  std::size_t max_cells = 2'000'000;
  bool pad = false;  ///< one layer of hexes under the boundary: better where the polycube has edges
                     ///< and the object none, at the price of a hex per boundary quad
  CompleteOptions complete;
};

/// A hex that could not be made positive, and where.
struct FoldedHex {
  HexId hex;
  Vec3 center;  ///< on the object
  double scaled_jacobian = 0;
  TetId tet;  ///< the tet of the object that holds the centre
  bool is_map_folded =
      false;  ///< that tet, or one that shares a vertex, is not positive in the map

  void to_world(const Similarity& frame) { center = frame.to_world(center); }
};

struct PolycubeReport {
  std::size_t num_tets = 0, num_nonpositive_object = 0, num_nonpositive_polycube = 0;
  std::size_t num_nonpositive_left = 0;  ///< in the polycube, after its map was repaired
  std::size_t num_charts = 0, num_unaligned_facets = 0;
  double max_plane_deviation =
      0;               ///< of a boundary vertex from its chart's plane, share of the spacing
  double spacing = 0;  ///< mean edge of a root cube, polycube units
  std::size_t num_roots = 0, num_sampled_cells = 0, num_cells = 0;
  std::size_t num_bridged =
      0;  ///< vertices located outside every positive tet, taken to the nearest
  std::size_t num_inverted_mapped = 0;  ///< hexes not positive right after mapping back
  std::size_t num_off_edges = 0;  ///< vertices let off the polycube's edges so that no hex inverts
  std::size_t num_off_surface = 0;  ///< boundary vertices left off the surface for that by more
                                    ///< than a third of max_surface_error
  double max_off_surface = 0;       ///< of them, share of the diagonal
  Vec3 farthest_off;                ///< the farthest of them
  int num_rounds = 0;               ///< meshes made; the best of them is the result
  double max_distance = 0;          ///< two-way, share of the diagonal; 0 when not measured
  std::vector<FoldedHex> folded;    ///< hexes of the result that are not positive
  std::vector<std::string> warnings;

  void to_world(const Similarity& frame);
};

struct PolycubeResult {
  HexMesh
      mesh;  ///< labels: patches are the polycube's faces, curves and corners its edges and corners
  Grid grid;        ///< on the polycube's integer lattice
  TriMesh surface;  ///< the object's boundary
  PolycubeReport report;
  /// Against that boundary, whose creases do not count: the mesh follows the map's own curves.
  Verdict verdict;

  void to_world(const Similarity& frame);
};

/// Errors: BadGeometry when the connectivities differ (names the tet), when the polycube's boundary
/// is not axis-aligned or a facet is far off its plane (names the facet);
/// OutOfResources past max_cells.
PolycubeResult mesh_polycube(const TetMesh& object, const TetMesh& polycube,
                             const PolycubeOptions& options, const Context& context);

}  // namespace hexwright
