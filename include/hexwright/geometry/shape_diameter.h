// Local thickness of a solid, by rays cast inwards.
//
// Based on: Shapira, Shamir, Cohen-Or, "Consistent mesh partitioning and skeletonisation using the
// shape diameter function", The Visual Computer 24, 2008. The sizing of Pitzalis et al. 2021,
// section 6.1.
#pragma once

#include <numbers>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/geometry/similarity.h"
#include "hexwright/geometry/surface_tree.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

struct ShapeDiameterOptions {
  double cone_angle = 2 * std::numbers::pi / 3;  ///< full opening of the cone, radians
  int num_rays = 25;                             ///< rays per sample
};

/// Shape diameter per triangle, in the surface's units; infinity where no ray hits a facing wall
/// (open or flipped input). The tree should be about unit size.
IdVector<TriId, double> compute_shape_diameter(const SurfaceTree& surface,
                                               const ShapeDiameterOptions& options,
                                               const Context& context);
/// One-shot for a surface of any size and position.
IdVector<TriId, double> compute_shape_diameter(const TriMesh& surface,
                                               const ShapeDiameterOptions& options,
                                               const Context& context);

/// A point on the surface and the distance to the walls that face it, inside and outside (infinity
/// when none).
struct WallSample {
  Vec3 point;
  TriId tri;
  double inner = 0;  ///< least thickness of the solid here
  double outer = 0;  ///< least width of the gap outside here

  void to_world(const Similarity& frame) {
    point = frame.to_world(point);
    inner = frame.length_to_world(inner);
    outer = frame.length_to_world(outer);
  }
};

/// Samples the surface every `spacing` (at least once per triangle; of more than 200,000 triangles
/// those smaller than the spacing in turns) and measures the opposite walls: the least (length x
/// cosine) over inward rays within 36 degrees that hit a triangle facing back (n . n' < -0.8).
/// The tree should be about unit size.
std::vector<WallSample> sample_opposite_walls(const SurfaceTree& surface, double spacing,
                                              const Context& context);
/// One-shot for a surface of any size and position.
std::vector<WallSample> sample_opposite_walls(const TriMesh& surface, double spacing,
                                              const Context& context);

}  // namespace hexwright
