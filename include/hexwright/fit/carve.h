// Keeps the hexes of a background mesh that lie inside (or outside) a surface, as a manifold set.
//
// Based on: Jacobson et al. 2013 and Barill et al. 2018 (winding number); docs/algorithms/fit.md,
// "Carve".
#pragma once

#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/geometry/expected_topology.h"
#include "hexwright/geometry/side.h"
#include "hexwright/geometry/similarity.h"
#include "hexwright/geometry/surface_tree.h"
#include "hexwright/mesh/hex_mesh.h"

namespace hexwright {

struct CarveOptions {
  Side side = Side::Inside;
  double keep_fraction = 0.5;  ///< filled fraction above which a hex is kept
  double visible_normal =
      0.1;  ///< least n . d of a direction d that sees all quads around a boundary vertex
  double min_component_share = 0.01;  ///< inside components smaller than this share of the largest
                                      ///< are dropped, but for as many as the surface has solids
};

struct CarveResult {
  std::vector<char> is_kept;  ///< per hex of the background: 1 = inside part
  std::size_t num_flips = 0;  ///< hexes changed to make the kept set manifold
  std::size_t num_bad_verts =
      0;  ///< boundary vertices the repair could not mend (0 in a usable result)
  std::size_t num_components = 0;
  std::size_t num_boundary_components = 0;
  long euler_characteristic = 0;  ///< of the kept set's boundary
  /// The threshold that the set was grown or shrunk from: keep_fraction where that gave the
  /// expected topology, or none did better.
  double seed_fraction = 0.5;
  /// Surface points in background hexes where a part or gap thinner than the grid was lost: one per
  /// hex, in order of the hexes.
  std::vector<Vec3> lost;
  /// Only when the set's topology is not the expected one: surface points in hexes of walls and
  /// gaps one hex thick, and in hexes whose faces the set's boundary passes by, in order of the
  /// hexes. Handles too many or too few are at some of them; smaller hexes there may mend it.
  std::vector<Vec3> thin;

  void to_world(const Similarity& frame);
};

/// `expected` is the topology that the kept set should have: where keep_fraction gives another,
/// thin parts or gaps are kept that it would have pierced.
CarveResult carve(const HexMesh& background, const SurfaceTree& surface,
                  const ExpectedTopology& expected, const CarveOptions& options,
                  const Context& context);
/// The same with the topology that the surface tells.
CarveResult carve(const HexMesh& background, const SurfaceTree& surface,
                  const CarveOptions& options, const Context& context);

/// The kept hexes as a mesh of their own.
HexMesh extract_hexes(const HexMesh& mesh, const std::vector<char>& is_kept);

}  // namespace hexwright
