// How far the surface inside a node departs from a plane.
//
// The triangles are clipped exactly to the node enlarged by a margin; pieces joined across
// non-crease edges inside it form a group, so that opposite sheets of a wall and the patches on
// both sides of a crease are judged apart. Each group has its area-weighted least-squares plane,
// from exact second moments of the pieces.
#include <algorithm>

#include "base/disjoint_sets.h"
#include "base/symmetric_eigen.h"
#include "grid/sizing/box_clip.h"
#include "grid/sizing/sizing_scene.h"

namespace hexwright::grids {
namespace {

/// Clipped triangles of one node, in its coordinates.
struct Pieces {
  std::vector<TriId> tris;          ///< ascending
  std::vector<std::size_t> offset;  ///< per piece into points, one more than pieces
  std::vector<Vec3> points;

  std::span<const Vec3> polygon(std::size_t piece) const {
    return {points.data() + offset[piece], offset[piece + 1] - offset[piece]};
  }
};

Pieces clip_pieces(const SizingScene& scene, const NodeCube& node, std::span<const TriId> tris,
                   double half) {
  Pieces pieces;
  pieces.offset.push_back(0);
  for (TriId t : tris) {
    const ClippedPolygon p = clip_to_cube(node.to_local(scene.surface.corners(t)), half);
    if (p.count < 3) continue;
    pieces.tris.push_back(t);
    pieces.points.insert(pieces.points.end(), p.points.begin(), p.points.begin() + p.count);
    pieces.offset.push_back(pieces.points.size());
  }
  return pieces;
}

/// Group of each piece: its lowest-numbered member, joined across smooth edges that run through the
/// cube.
std::vector<std::size_t> group_pieces(const SizingScene& scene, const NodeCube& node,
                                      const Pieces& pieces, double half) {
  DisjointSets groups(pieces.tris.size());
  for (std::size_t i = 0; i < pieces.tris.size(); ++i) {
    const TriId t = pieces.tris[i];
    for (std::size_t le = 0; le < 3; ++le) {
      const TriId other = scene.smooth_neighbor[t][le];
      if (!other.is_valid() || other < t) continue;  // each pair once
      const auto it = std::lower_bound(pieces.tris.begin(), pieces.tris.end(), other);
      if (it == pieces.tris.end() || *it != other) continue;
      const auto p = scene.surface.corners(t);
      if (!segment_meets_cube(node.to_local(p[le]), node.to_local(p[(le + 1) % 3]), half)) continue;
      groups.unite(i, static_cast<std::size_t>(it - pieces.tris.begin()));
    }
  }
  std::vector<std::size_t> group(pieces.tris.size());
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = groups.find(i);
  return group;
}

/// Area, first and second moments of polygons about the node's centre. The moments of a triangle
/// abc of area A are exact: first A (a+b+c)/3, second A/12 ((a+b+c)(a+b+c)^T + aa^T + bb^T + cc^T).
struct Moments {
  double area = 0;
  Vec3 first;
  double second[6] = {};  ///< xx, xy, xz, yy, yz, zz

  void add(std::span<const Vec3> polygon) {
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
      add(polygon[0], polygon[k], polygon[k + 1]);
  }
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double w = norm(cross(b - a, c - a)) / 2;
    const Vec3 s = a + b + c;
    area += w;
    first += s * (w / 3);
    int entry = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        second[entry++] += w / 12 * (s[i] * s[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]);
  }
  Vec3 centroid() const { return first / area; }
  /// Normal of the plane of least squared distance: the eigenvector of the least eigenvalue of the
  /// central second moments.
  Vec3 plane_normal() const {
    const Vec3 c = centroid();
    std::array<double, 6> central;
    std::size_t entry = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j, ++entry) central[entry] = second[entry] - area * c[i] * c[j];
    return least_eigenvector(central);
  }
};

}  // namespace

double compute_plane_spread(const SizingScene& scene, const NodeCube& node,
                            std::span<const TriId> tris) {
  const double half = 0.5 + kDeviationMargin;
  const Pieces pieces = clip_pieces(scene, node, tris, half);
  const std::vector<std::size_t> group = group_pieces(scene, node, pieces, half);
  std::vector<Moments> moments(group.size());
  for (std::size_t i = 0; i < group.size(); ++i) moments[group[i]].add(pieces.polygon(i));
  constexpr double kNegligibleArea = 1e-12;  // of the node's face
  struct Slab {
    Vec3 normal;
    double lo = 1e300, hi = -1e300;
  };
  std::vector<Slab> slab(group.size());
  for (std::size_t i = 0; i < group.size(); ++i)
    if (group[i] == i && moments[i].area > kNegligibleArea)
      slab[i].normal = moments[i].plane_normal();
  double spread = 0;
  for (std::size_t i = 0; i < group.size(); ++i) {
    Slab& s = slab[group[i]];
    for (const Vec3& p : pieces.polygon(i)) {
      const double d = dot(p, s.normal);
      s.lo = std::min(s.lo, d);
      s.hi = std::max(s.hi, d);
    }
    spread = std::max(spread, s.hi - s.lo);
  }
  return spread;
}

}  // namespace hexwright::grids
