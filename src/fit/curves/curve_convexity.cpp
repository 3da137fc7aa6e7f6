// An edge is convex when the second triangle lies behind the plane of the first.
#include "fit/curves/curve_convexity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hexwright/base/function_ref.h"

#include "geometry/topology/surface_edges.h"
#include "geometry/tree/triangle_math.h"

namespace hexwright::fitting {
namespace {

bool is_convex(const TriMesh& surface, const SurfaceEdges& edges, std::size_t e) {
  const auto sides = edges.sides_of(e);
  const auto p = surface.corners(sides[0].tri);
  const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
  const auto& other = surface.tris[sides[1].tri];
  const VertId apex = other[static_cast<std::size_t>((sides[1].k + 2) % 3)];
  return dot(normal, surface.positions[apex] - p[0]) < 0;
}

/// Between the triangles of an edge; triangles that are oriented differently count as if alike.
double wedge_angle(const TriMesh& surface, const SurfaceEdges& edges, std::size_t e) {
  const auto sides = edges.sides_of(e);
  const double sign = sides[0].is_forward != sides[1].is_forward ? 1 : -1;
  const double cosine = sign * dot(unit_normal(surface.corners(sides[0].tri)),
                                   unit_normal(surface.corners(sides[1].tri)));
  return std::numbers::pi - std::acos(std::clamp(cosine, -1.0, 1.0));
}

/// The mean of a number over the length of a curve's edges with two triangles.
IdVector<CurveId, double> average_along(const TriMesh& surface, const FeatureGraph& features,
                                        double otherwise,
                                        FunctionRef<double(const SurfaceEdges&, std::size_t)> at) {
  const SurfaceEdges edges = compute_surface_edges(surface);
  IdVector<CurveId, double> averages(features.curves.size(), otherwise);
  for (CurveId c : features.curves.ids()) {
    const FeatureCurve& curve = features.curves[c];
    double total = 0, sum = 0;
    for (std::size_t i = 0; i + 1 < curve.verts.size(); ++i) {
      const long e = edges.find(curve.verts[i], curve.verts[i + 1]);
      if (e < 0 || edges.sides_of(static_cast<std::size_t>(e)).size() != 2) continue;
      const double length = curve.arc_length[i + 1] - curve.arc_length[i];
      total += length;
      sum += length * at(edges, static_cast<std::size_t>(e));
    }
    if (total > 0) averages[c] = sum / total;
  }
  return averages;
}

}  // namespace

IdVector<CurveId, double> compute_convex_shares(const TriMesh& surface,
                                                const FeatureGraph& features) {
  return average_along(surface, features, 0, [&](const SurfaceEdges& edges, std::size_t e) {
    return is_convex(surface, edges, e) ? 1.0 : 0.0;
  });
}

IdVector<CurveId, double> compute_wedge_angles(const TriMesh& surface,
                                               const FeatureGraph& features) {
  return average_along(
      surface, features, std::numbers::pi,
      [&](const SurfaceEdges& edges, std::size_t e) { return wedge_angle(surface, edges, e); });
}

}  // namespace hexwright::fitting
