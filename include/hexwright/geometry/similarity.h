// A change of scale, position and pose, so that stages can work at unit size, along the axes of the
// model's faces, whatever its units.
#pragma once

#include <cmath>

#include "hexwright/geometry/rotation.h"
#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

/// world = center + pose^-1 (unit) * 2^exponent. The scale is a power of two, so scaling loses
/// nothing; only the shift rounds, to the last bit of the world coordinate, and a pose that is not
/// the identity.
struct Similarity {
  Vec3 center;
  int exponent = 0;
  Rotation pose = {};

  Vec3 to_unit(const Vec3& p) const { return pose.apply(scaled(p - center, -exponent)); }
  Vec3 to_world(const Vec3& p) const { return scaled(pose.apply_inverse(p), exponent) + center; }
  /// Zero or infinity when they leave the range of doubles.
  double length_to_unit(double length) const { return std::ldexp(length, -exponent); }
  double length_to_world(double length) const { return std::ldexp(length, exponent); }
  double volume_to_world(double volume) const { return std::ldexp(volume, 3 * exponent); }

 private:
  static Vec3 scaled(const Vec3& p, int e) {
    return {std::ldexp(p.x, e), std::ldexp(p.y, e), std::ldexp(p.z, e)};
  }
};

/// The similarity whose unit frame has the box about the origin with its longest side in [1, 2).
/// Safe for coordinates whose squares overflow or vanish. The identity for an empty box or one
/// without extent.
Similarity compute_unit_frame(const Box3& box);
/// That of the surface's box.
Similarity compute_unit_frame(const TriMesh& surface);

/// The mesh with its positions mapped to the unit frame.
TriMesh to_unit(TriMesh surface, const Similarity& frame);
HexMesh to_unit(HexMesh mesh, const Similarity& frame);

/// The mesh with its positions mapped back to the world.
TriMesh to_world(TriMesh surface, const Similarity& frame);
HexMesh to_world(HexMesh mesh, const Similarity& frame);

}  // namespace hexwright
