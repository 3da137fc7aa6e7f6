// Closest point, first hit of a ray and generalised winding number on any triangle soup, from one
// bounding volume hierarchy.
//
// Based on: Barill, Dickson, Schmidt, Levin, Jacobson, "Fast Winding Numbers for Soups and Clouds",
// ACM TOG 37(4), 2018; Jacobson, Kavan, Sorkine-Hornung, "Robust Inside-Outside Segmentation using
// Generalized Winding Numbers", ACM TOG 32(4), 2013.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "hexwright/base/function_ref.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

class PatchIndex;
struct TriangleBvh;

struct ClosestPoint {
  TriId tri;
  Vec3 point;
  double distance_sq = std::numeric_limits<double>::infinity();
};

/// Where a ray meets the surface.
struct RayHit {
  TriId tri;
  double length = 0;  ///< from the ray's start
};

/// Restricts a closest-point query. The defaults restrict nothing.
struct ClosestFilter {
  double max_distance = std::numeric_limits<double>::infinity();  ///< farther points are not found
  Vec3 normal;             ///< unit vector compared with triangle normals when min_cosine >= -1
  double min_cosine = -2;  ///< keep triangles with normal . tri_normal >= min_cosine
  PatchId patch;           ///< keep triangles of this patch of `patches` when valid
  const PatchIndex* patches = nullptr;  ///< of the same tree; without it no triangle has a patch
  TriId hint;  ///< a triangle likely to be near, e.g. of the last query; speeds up only
};

/// Immutable after construction; queries are thread-safe and deterministic: among equally near
/// points the lowest triangle id wins.
class SurfaceTree {
 public:
  /// `diagonal`: the length that tolerances are shares of, where it is not that of the surface's
  /// box: a turned surface keeps the diagonal it was given with.
  explicit SurfaceTree(TriMesh surface, double diagonal = 0);
  ~SurfaceTree();
  SurfaceTree(SurfaceTree&&) noexcept;
  SurfaceTree& operator=(SurfaceTree&&) noexcept;

  const TriMesh& surface() const;
  const Box3& box() const;
  double diagonal() const;
  /// Unit normal by orientation; zero for a degenerate triangle.
  const Vec3& normal(TriId t) const;

  /// The nearest surface point; absent only when the filter excludes everything (or the surface is
  /// empty).
  std::optional<ClosestPoint> closest(const Vec3& p, const ClosestFilter& filter = {}) const;
  /// The first triangle that a ray from p meets in unit direction d, of those for which `counts`
  /// (called with what is met, in no certain order) is true. Edges and corners belong to all their
  /// triangles, so no ray slips through between them; among equally near ones the lowest id wins.
  std::optional<RayHit> first_hit(const Vec3& p, const Vec3& d,
                                  FunctionRef<bool(const RayHit&)> counts) const;
  /// Distance to the surface, infinity when it is empty.
  double distance(const Vec3& p) const;

  /// Generalised winding number: 1 inside, 0 outside for a closed, outward-oriented surface; in
  /// between for open ones. Far nodes count as dipoles when farther than `accuracy` times their
  /// radius.
  double winding_number(const Vec3& p, double accuracy = 2.3) const;
  /// winding_number(p) > 0.5.
  bool is_inside(const Vec3& p) const { return winding_number(p) > 0.5; }

 private:
  friend class PatchIndex;
  const TriangleBvh& bvh() const;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hexwright
