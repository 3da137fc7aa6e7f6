// The frame is found from halves of coordinates, which neither overflow nor lose a bit.
#include "hexwright/geometry/similarity.h"

#include <algorithm>
#include <utility>

#include "hexwright/base/parallel.h"

namespace hexwright {
namespace {

template <class Map>
void map_all(std::vector<Vec3>& positions, Map&& map) {
  parallel_for(positions.size(), [&](std::size_t i) { positions[i] = map(positions[i]); });
}

template <class Map>
TriMesh mapped(TriMesh mesh, Map&& map) {
  map_all(mesh.positions.raw(), map);
  return mesh;
}

template <class Map>
HexMesh mapped(HexMesh mesh, Map&& map) {
  map_all(mesh.positions.raw(), map);
  if (!mesh.mid_nodes) return mesh;
  map_all(mesh.mid_nodes->edges.raw(), map);
  for (auto& inner : mesh.mid_nodes->inner)
    for (Vec3& p : inner) p = map(p);
  return mesh;
}

}  // namespace

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
  return mapped(std::move(surface), [&](const Vec3& p) { return frame.to_unit(p); });
}

HexMesh to_unit(HexMesh mesh, const Similarity& frame) {
  return mapped(std::move(mesh), [&](const Vec3& p) { return frame.to_unit(p); });
}

TriMesh to_world(TriMesh surface, const Similarity& frame) {
  return mapped(std::move(surface), [&](const Vec3& p) { return frame.to_world(p); });
}

HexMesh to_world(HexMesh mesh, const Similarity& frame) {
  return mapped(std::move(mesh), [&](const Vec3& p) { return frame.to_world(p); });
}

}  // namespace hexwright
