// What the sizing criteria read: triangles and who adjoins whom across non-crease edges, wall
// samples, crease segments, shape diameters. Immutable while the grid is built.
#pragma once

#include <array>
#include <vector>

#include "hexwright/geometry/feature_graph.h"
#include "hexwright/geometry/shape_diameter.h"
#include "hexwright/grid/sizing.h"

namespace hexwright::grids {

struct CreaseSegment {
  Vec3 a, b;
  CurveId curve;
};

struct SizingScene {
  const TriMesh& surface;
  const FeatureGraph& features;
  double diagonal = 0;  ///< of the surface's box
  /// Per triangle and edge (v, v+1): the triangle across it; invalid at creases and at edges that
  /// do not have exactly two triangles.
  IdVector<TriId, std::array<TriId, 3>> smooth_neighbor;
  std::vector<WallSample> walls;               ///< only those with a wall that faces them
  IdVector<TriId, double> diameter;            ///< Thickness only
  std::vector<CreaseSegment> crease_segments;  ///< crease proximity only
};

/// The tree should be about unit size.
SizingScene make_sizing_scene(const SurfaceTree& tree, const FeatureGraph& features,
                              const SizingOptions& options, const Context& context);

/// What may matter to a node: everything near its (enlarged) cube. Children inherit their parent's.
struct SizingCandidates {
  std::vector<TriId> tris;              ///< ascending
  std::vector<std::uint32_t> walls;     ///< indices into SizingScene::walls
  std::vector<std::uint32_t> segments;  ///< indices into SizingScene::crease_segments
  std::vector<VertId> corners;
};

/// A node's cube and the map of the world into its own coordinates, where it is [-0.5, 0.5]^3.
/// Working there makes every tolerance relative to the node, wherever the model lies.
struct NodeCube {
  Vec3 center;
  double edge = 1;  ///< the longest
  Vec3 edges = {1, 1, 1};
  Vec3 to_local(const Vec3& p) const {
    const Vec3 d = p - center;
    return {d.x / edges.x, d.y / edges.y, d.z / edges.z};
  }
  Box3 box() const { return {center - edges * 0.5, center + edges * 0.5}; }
  std::array<Vec3, 3> to_local(const std::array<Vec3, 3>& p) const {
    return {to_local(p[0]), to_local(p[1]), to_local(p[2])};
  }
};

/// How far beyond a node, as a share of its edge, the surface still counts for its plane.
inline constexpr double kDeviationMargin = 0.1;
/// A node meets the surface when the surface comes this near, as a share of its edge.
inline constexpr double kTouchMargin = 0.02;

/// The greatest spread (max - min signed distance, in node edges) of any smooth group of surface
/// pieces in the node about its own least-squares plane. `tris` must be ascending and hold every
/// triangle that meets the enlarged node.
double compute_plane_spread(const SizingScene& scene, const NodeCube& node,
                            std::span<const TriId> tris);

/// Whether a curve or corner in the node comes within `reach` node edges of one it is not joined
/// to.
bool has_crowded_creases(const SizingScene& scene, const NodeCube& node,
                         const SizingCandidates& near, double reach);

}  // namespace hexwright::grids
