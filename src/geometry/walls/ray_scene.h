// Rays against a surface, at any scale and position.
//
// Based on: Wald, Woop, Benthin, Johnson, Ernst, "Embree: a kernel framework for efficient CPU ray
// tracing", ACM TOG 33(4), 2014, through its library.
// Differs: the library's floats hold the surface in its unit frame; lengths are computed again in
// doubles from the plane that was hit.
#pragma once

#include <memory>
#include <optional>

#include "hexwright/geometry/similarity.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

struct RayHit {
  TriId tri;
  double length = 0;  ///< world units
};

class RayScene {
 public:
  explicit RayScene(const TriMesh& surface);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Unit normal by orientation, zero for a triangle without area.
  const Vec3& normal(TriId t) const;
  /// The surface in the unit frame.
  const TriMesh& unit_surface() const;
  const Similarity& frame() const;

  /// First wall met by a ray that leaves `from` (on triangle `source`, in the unit frame) in unit
  /// direction `direction`. The source and what is coplanar with it are passed through.
  std::optional<RayHit> first_wall(const Vec3& from, TriId source, const Vec3& direction) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

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
