// From a surface with a polycube labelling to the pair of tet meshes that mesh_polycube() takes.
//
// Based on: PolyCut (Livesu et al. 2013) and its followers, for what a labelling is; the tets are
// hexwright's own (docs/algorithms/polycube.md).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/mesh/tet_mesh.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

struct PolycubeMapOptions {
  /// Distance allowed between the given surface and the object's tets, share of the diagonal.
  double tolerance = 0.005;
  std::size_t max_hexes = 50'000;  ///< that are cut into 24 tets each
};

struct PolycubeMap {
  TetMesh object, polycube;  ///< equal tets, all positive in both, in the surface's units
  std::size_t num_charts = 0, num_corners = 0;
  double max_distance = 0;  ///< of the object's boundary from the surface, two-way, as a share
  /// Volume of a tet in the polycube over that in the object, in units of the whole's.
  double least_stretch = 0, greatest_stretch = 0;
  std::vector<std::string> warnings;
};

/// Meshes the surface with hexes that follow the borders between labels, cuts them into tets, and
/// deforms these until each face of equal labels is flat and looks along its axis. For shapes of
/// one piece, whose labels are those of a polycube. Errors: BadArgument when there is not one label
/// per triangle; BadGeometry when the surface is open or of several parts, or, with the place and
/// the remedy, when the labels are those of no polycube, or of one that folds.
PolycubeMap make_polycube_map(const TriMesh& surface, std::span<const std::uint8_t> labels,
                              const PolycubeMapOptions& options, const Context& context);

}  // namespace hexwright
