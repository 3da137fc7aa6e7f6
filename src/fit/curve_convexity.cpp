// An edge is convex when the second triangle lies behind the plane of the first.
#include "fit/curve_convexity.h"

#include "geometry/surface_edges.h"

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

}  // namespace

IdVector<CurveId, double> compute_convex_shares(const TriMesh& surface,
                                                const FeatureGraph& features) {
  const SurfaceEdges edges = compute_surface_edges(surface);
  IdVector<CurveId, double> shares(features.curves.size(), 0.0);
  for (CurveId c : features.curves.ids()) {
    const FeatureCurve& curve = features.curves[c];
    double total = 0, convex = 0;
    for (std::size_t i = 0; i + 1 < curve.verts.size(); ++i) {
      const long e = edges.find(curve.verts[i], curve.verts[i + 1]);
      if (e < 0 || edges.sides_of(static_cast<std::size_t>(e)).size() != 2) continue;
      const double length = curve.arc_length[i + 1] - curve.arc_length[i];
      total += length;
      if (is_convex(surface, edges, static_cast<std::size_t>(e))) convex += length;
    }
    if (total > 0) shares[c] = convex / total;
  }
  return shares;
}

}  // namespace hexwright::fitting
