// The frame is found from halves of coordinates, which neither overflow nor lose a bit.
#include "hexwright/geometry/similarity.h"

#include <algorithm>

namespace hexwright {

Similarity compute_unit_frame(const TriMesh& surface) {
  Similarity frame;
  const Box3 box = bounding_box(surface);
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

TriMesh to_unit(const TriMesh& surface, const Similarity& frame) {
  TriMesh unit = surface;
  for (Vec3& p : unit.positions) p = frame.to_unit(p);
  return unit;
}

}  // namespace hexwright
