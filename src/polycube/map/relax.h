// Optimises a mapped mesh on the object: untangles it, then improves it, with boundary vertices on
// the faces, edges and corners of the polycube's image.
#pragma once

#include "hexwright/base/context.h"
#include "hexwright/geometry/surface_tree.h"

#include "polycube/map/map_back.h"

namespace hexwright::polycube {

struct RelaxOptions {
  bool pad = false;  ///< put one layer of hexes under the boundary
  /// In the mesh's units; vertices farther off are brought back at any cost short of nearly flat
  /// hexes, the others while quality hardly suffers.
  double near_surface = 0;
};

/// What the mesh is relaxed onto.
struct RelaxScene {
  const ObjectFeatures& object;
  const Lattice& lattice;
  const SurfaceTree& tree;  ///< of object.surface
};

struct RelaxReport {
  std::size_t num_off_edges = 0;    ///< vertices let off the polycube's edges and corners
  std::size_t num_off_surface = 0;  ///< boundary vertices farther than `near_surface` off
  double max_off_surface = 0;       ///< the largest distance of one, in the mesh's units
  Vec3 farthest_off;                ///< where
};

/// Labels the boundary (patch = chart, curves, corners) and moves vertices; never inverts a hex
/// that is not inverted.
RelaxReport relax(MappedMesh& mapped, const RelaxScene& scene, const RelaxOptions& options,
                  const Context& context);

}  // namespace hexwright::polycube
