// Whether sharp features crowd in a node: two curves or corners that are not joined nearby.
#include <algorithm>

#include "grid/sizing/box_clip.h"
#include "grid/sizing/sizing_scene.h"

namespace hexwright::grids {
namespace {

double max_norm(const Vec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// Two corners near the node, one of them in it.
bool has_crowded_corners(const SizingScene& scene, const NodeCube& node,
                         std::span<const VertId> corners, double reach) {
  int num_near = 0;
  bool is_one_inside = false;
  for (VertId v : corners) {
    const double d = max_norm(node.to_local(scene.surface.positions[v]));
    num_near += d <= 0.5 + reach;
    is_one_inside |= d <= 0.5 + kTouchMargin;
  }
  return num_near >= 2 && is_one_inside;
}

std::vector<CurveId> find_curves_within(const SizingScene& scene, const NodeCube& node,
                                        std::span<const std::uint32_t> segments, double half) {
  std::vector<CurveId> curves;
  for (std::uint32_t s : segments) {
    const CreaseSegment& segment = scene.crease_segments[s];
    if (segment_meets_cube(node.to_local(segment.a), node.to_local(segment.b), half))
      curves.push_back(segment.curve);
  }
  std::sort(curves.begin(), curves.end());
  curves.erase(std::unique(curves.begin(), curves.end()), curves.end());
  return curves;
}

/// Curves that end at one vertex near the node are expected to be near each other there.
bool are_joined_nearby(const SizingScene& scene, const NodeCube& node, CurveId a, CurveId b,
                       double reach) {
  const auto& u = scene.features.curves[a].verts;
  const auto& w = scene.features.curves[b].verts;
  for (VertId p : {u.front(), u.back()})
    for (VertId q : {w.front(), w.back()})
      if (p == q && max_norm(node.to_local(scene.surface.positions[p])) < 1.5 + 2 * reach)
        return true;
  return false;
}

}  // namespace

bool has_crowded_creases(const SizingScene& scene, const NodeCube& node,
                         const SizingCandidates& near, double reach) {
  if (has_crowded_corners(scene, node, near.corners, reach)) return true;
  const auto inside = find_curves_within(scene, node, near.segments, 0.5 + kTouchMargin);
  if (inside.empty()) return false;
  const auto around = find_curves_within(scene, node, near.segments, 0.5 + reach);
  for (CurveId a : inside)
    for (CurveId b : around)
      if (a != b && !are_joined_nearby(scene, node, a, b, reach)) return true;
  return false;
}

}  // namespace hexwright::grids
