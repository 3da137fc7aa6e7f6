// Rays from the triangles of a surface to the walls that face them.
#pragma once

#include <optional>
#include <vector>

#include "hexwright/geometry/surface_tree.h"

namespace hexwright {

/// First wall met by a ray that leaves `from` (on triangle `source`) in unit direction `direction`.
/// The source and what is coplanar with it are passed through. The tree should be about unit size.
std::optional<RayHit> first_wall(const SurfaceTree& tree, const Vec3& from, TriId source,
                                 const Vec3& direction);

/// Directions in the cone about +z with half opening `half_angle`, evenly spread, from the axis
/// outwards (a spiral by the golden angle); with the angle of each from the axis.
struct ConeRay {
  Vec3 direction;
  double angle = 0;
};
std::vector<ConeRay> spread_cone(int num_rays, double half_angle);

/// An orthonormal frame whose third axis is n.
struct AxisFrame {
  Vec3 x, y, z;
  explicit AxisFrame(const Vec3& n);
  Vec3 to_world(const Vec3& d) const { return x * d.x + y * d.y + z * d.z; }
};

}  // namespace hexwright
