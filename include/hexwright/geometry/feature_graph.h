// Sharp features of a surface: crease curves, corners, and the smooth patches between them.
#pragma once

#include <array>
#include <numbers>
#include <span>
#include <vector>

#include "hexwright/geometry/surface_tree.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

struct FeatureOptions {
  double crease_angle =
      50 * std::numbers::pi / 180;  ///< deviation of the two normals from flat, radians
  double turn_angle =
      50 * std::numbers::pi / 180;  ///< a curve turning by more has a corner there, radians
  double min_length = 0;  ///< dangling chains and loops shorter than this (world units) are pruned
  /// Creases given by the user, taken besides the angle's: edges as pairs of vertices of the
  /// surface that features are extracted from ...
  std::vector<std::array<VertId, 2>> extra_edges;
  /// ... or as straight segments in that surface's coordinates, from vertex to vertex along one
  /// edge or several. These stay right when a surface is cleaned and renumbered.
  std::vector<std::array<Vec3, 2>> extra_segments;
};

/// A chain of surface vertices between two corners, or a closed loop.
struct FeatureCurve {
  std::vector<VertId> verts;       ///< a loop repeats its first vertex at the end
  std::vector<double> arc_length;  ///< per vertex of the chain, from 0 to length()
  bool is_closed = false;          ///< a loop without a corner
  double length() const { return arc_length.empty() ? 0 : arc_length.back(); }
};

struct FeatureGraph {
  IdVector<CurveId, FeatureCurve> curves;
  std::vector<VertId> corners;  ///< surface vertices where curves end, meet or turn; sorted
  /// Of FeatureOptions::extra_segments: those without edges of the surface along them.
  std::size_t num_unmatched_segments = 0;

  bool empty() const { return curves.empty() && corners.empty(); }
  double total_length() const;
};

/// The edges of a surface that are creases by angle, boundary or non-manifold edges or borders
/// between named groups, without those that lie off the solid's boundary. Linear but for winding
/// numbers, which are slow among needles.
std::vector<std::array<VertId, 2>> find_creases(const SurfaceTree& surface, double crease_angle);

/// Creases by dihedral angle, boundary and non-manifold edges, borders between the surface's groups
/// whatever their angle, and the user's; chained, pruned, with corners.
FeatureGraph extract_features(const TriMesh& surface, const FeatureOptions& options);
/// The same without creases that lie off the solid's boundary (see exposure.h), as inside the union
/// of overlapping parts: no mesh edge can follow them. The user's edges all stay.
FeatureGraph extract_features(const SurfaceTree& surface, const FeatureOptions& options);
/// The same, with what find_creases() gave for this surface and the options' angle, in any order.
FeatureGraph extract_features(const SurfaceTree& surface, const FeatureOptions& options,
                              std::span<const std::array<VertId, 2>> creases);

/// Patch of each triangle: components connected across edges that are on none of the curves with
/// `is_barrier` set. An empty span means all curves separate.
IdVector<TriId, PatchId> compute_patches(const TriMesh& surface, const FeatureGraph& features,
                                         std::span<const char> is_barrier = {});

/// The point nearest to a position on a curve, restricted to an interval of its arc length.
struct CurvePoint {
  Vec3 point;
  Vec3 tangent;  ///< unit
  double arc = 0;
  double distance_sq = 0;
};
CurvePoint closest_on_curve(const TriMesh& surface, const FeatureCurve& curve, const Vec3& p);
/// Considers only arcs in [arc_lo, arc_hi]; a closed curve wraps around.
CurvePoint closest_on_curve(const TriMesh& surface, const FeatureCurve& curve, const Vec3& p,
                            double arc_lo, double arc_hi);
/// The point at an arc length (clamped, or wrapped on a closed curve).
CurvePoint point_at_arc(const TriMesh& surface, const FeatureCurve& curve, double arc);

}  // namespace hexwright
