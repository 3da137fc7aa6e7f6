// Prepares a surface for the sizing criteria.
#include "grid/sizing/sizing_scene.h"

#include <algorithm>
#include <cmath>

#include "hexwright/base/parallel.h"

namespace hexwright::grids {
namespace {

/// Spacing of the wall samples, as a share of the diagonal.
constexpr double kWallSampleSpacing = 1.0 / 90;

std::uint64_t edge_key(VertId a, VertId b) {
  const auto lo = static_cast<std::uint64_t>(std::min(a, b).value());
  const auto hi = static_cast<std::uint64_t>(std::max(a, b).value());
  return lo << 32 | hi;
}

std::vector<std::uint64_t> collect_crease_edges(const FeatureGraph& features) {
  std::vector<std::uint64_t> edges;
  for (const FeatureCurve& curve : features.curves)
    for (std::size_t k = 0; k + 1 < curve.verts.size(); ++k)
      edges.push_back(edge_key(curve.verts[k], curve.verts[k + 1]));
  std::sort(edges.begin(), edges.end());
  return edges;
}

struct EdgeUse {
  std::uint64_t key = 0;
  TriId tri;
  int le = 0;
};

IdVector<TriId, std::array<TriId, 3>> compute_smooth_neighbors(const TriMesh& surface,
                                                               const FeatureGraph& features) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * surface.num_tris());
  for (TriId t : surface.tris.ids())
    for (int le = 0; le < 3; ++le) {
      const auto& v = surface.tris[t];
      uses.push_back(
          {edge_key(v[static_cast<std::size_t>(le)], v[static_cast<std::size_t>((le + 1) % 3)]), t,
           le});
    }
  parallel_stable_sort(uses.begin(), uses.end(),
                       [](const EdgeUse& a, const EdgeUse& b) { return a.key < b.key; });
  const std::vector<std::uint64_t> creases = collect_crease_edges(features);
  IdVector<TriId, std::array<TriId, 3>> neighbor(surface.num_tris());
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t end = i + 1;
    while (end < uses.size() && uses[end].key == uses[i].key) ++end;
    if (end - i == 2 && !std::binary_search(creases.begin(), creases.end(), uses[i].key)) {
      neighbor[uses[i].tri][static_cast<std::size_t>(uses[i].le)] = uses[i + 1].tri;
      neighbor[uses[i + 1].tri][static_cast<std::size_t>(uses[i + 1].le)] = uses[i].tri;
    }
    i = end;
  }
  return neighbor;
}

std::vector<CreaseSegment> collect_crease_segments(const TriMesh& surface,
                                                   const FeatureGraph& features) {
  std::vector<CreaseSegment> segments;
  for (CurveId c : features.curves.ids()) {
    const auto& verts = features.curves[c].verts;
    for (std::size_t k = 0; k + 1 < verts.size(); ++k)
      segments.push_back({surface.positions[verts[k]], surface.positions[verts[k + 1]], c});
  }
  return segments;
}

}  // namespace

SizingScene make_sizing_scene(const SurfaceTree& tree, const FeatureGraph& features,
                              const SizingOptions& options, const Context& context) {
  const TriMesh& surface = tree.surface();
  SizingScene scene{surface, features, tree.box().diagonal(), {}, {}, {}, {}};
  if (options.sizing == Sizing::Thickness) {
    scene.diameter = compute_shape_diameter(tree, {}, context);
    return scene;
  }
  scene.smooth_neighbor = compute_smooth_neighbors(surface, features);
  if (options.wall_factor > 0) {
    scene.walls = sample_opposite_walls(tree, kWallSampleSpacing * scene.diagonal, context);
    std::erase_if(scene.walls, [](const WallSample& s) { return !std::isfinite(s.inner); });
  }
  if (options.crease_proximity > 0)
    scene.crease_segments = collect_crease_segments(surface, features);
  return scene;
}

}  // namespace hexwright::grids
