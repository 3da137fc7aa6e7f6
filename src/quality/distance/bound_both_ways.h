// Bounds of the largest distances between a surface and the patches of a mesh's boundary.
#pragma once

#include "hexwright/geometry/surface_tree.h"
#include "hexwright/mesh/hex_mesh.h"

#include "quality/distance/distance_bound.h"

namespace hexwright {

/// What samples have told of one direction.
struct SampledDirection {
  double max = 0;
  Vec3 worst = {};
  std::vector<double> vert_distance = {};  ///< per vertex of what was sampled; 0 at unused ones
  std::vector<TriId> vert_nearest = {};    ///< of the reference
  FunctionRef<bool(const Vec3& p, double distance)> counts;
  bool has_excuses = false;
};

struct BothWays {
  const HexMesh& mesh;
  const std::vector<std::array<VertId, 4>>& quads;
  const SurfaceTree& surface;
  const SurfaceTree& boundary;  ///< of the quads' facets, as triangulate_quads() makes them
  double gap = 0;               ///< of each direction's bounds, in the mesh's units
  double least_excused = 0;
};

struct BoundsBothWays {
  DistanceBounds to_mesh, to_surface;
};

/// Lower bounds hold for the patches, upper bounds too, and are all that counts in the result.
BoundsBothWays bound_both_ways(const BothWays& input, const SampledDirection& to_mesh,
                               const SampledDirection& to_surface);

}  // namespace hexwright
