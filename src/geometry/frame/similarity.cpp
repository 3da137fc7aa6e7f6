// The frame is found from halves of coordinates, which neither overflow nor lose a bit.
#include "hexwright/geometry/similarity.h"

#include <algorithm>

#include "hexwright/base/parallel.h"

namespace hexwright {

Similarity compute_unit_frame(const Box3& box) {
  Similarity frame;
  if (box.is_empty()) return frame;
  // Halves first: sums and differences of huge coordinates could overflow.
  const Vec3 half = box.hi * 0.5 - box.lo * 0.5;
  const double longest_half = std::max({half.x, half.y, half.z});
  if (!(longest_half > 0) || !std::isfinite(longest_half)) return frame;
  frame.center = box.lo * 0.5 + box.hi * 0.5;
  // The longest side is 2 * longest_half, in [2, 4) * 2^ilogb: scaled by 2^-(ilogb + 1) in [1, 2).
  frame.exponent = std::ilogb(longest_half) + 1;
  return frame;
}

Similarity compute_unit_frame(const TriMesh& surface) {
  return compute_unit_frame(bounding_box(surface));
}

TriMesh to_unit(TriMesh surface, const Similarity& frame) {
  for (Vec3& p : surface.positions) p = frame.to_unit(p);
  return surface;
}

HexMesh to_unit(HexMesh mesh, const Similarity& frame) {
  parallel_for(mesh.num_verts(), [&](std::size_t i) {
    Vec3& p = mesh.positions[VertId(i)];
    p = frame.to_unit(p);
  });
  return mesh;
}

TriMesh to_world(TriMesh surface, const Similarity& frame) {
  for (Vec3& p : surface.positions) p = frame.to_world(p);
  return surface;
}

HexMesh to_world(HexMesh mesh, const Similarity& frame) {
  parallel_for(mesh.num_verts(), [&](std::size_t i) {
    Vec3& p = mesh.positions[VertId(i)];
    p = frame.to_world(p);
  });
  return mesh;
}

}  // namespace hexwright
