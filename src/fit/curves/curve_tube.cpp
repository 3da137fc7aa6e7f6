// Every curve segment asks the tree for the vertices near it; each vertex keeps its best segment.
#include "fit/curves/curve_tube.h"

#include <algorithm>
#include <tuple>

namespace hexwright::fitting {

using namespace relax;
namespace {

struct Candidate {
  VertId vert;
  double distance_sq;
  double arc;
};

/// Squared distance from p to the segment from a to b, and the parameter of the nearest point.
double distance_sq_to_segment(const Vec3& p, const Vec3& a, const Vec3& b, double& t) {
  const Vec3 d = b - a;
  const double length_sq = norm_sq(d);
  t = length_sq > 0 ? std::clamp(dot(p - a, d) / length_sq, 0.0, 1.0) : 0.0;
  return norm_sq(a + d * t - p);
}

}  // namespace

std::vector<TubeVert> compute_tube(const BoundaryQuads& boundary, const VertReach& reach_tree,
                                   const TriMesh& surface, const FeatureCurve& curve,
                                   double reach) {
  std::vector<Candidate> candidates;
  std::vector<VertId> found;
  for (std::size_t i = 0; i + 1 < curve.verts.size(); ++i) {
    const Vec3& a = surface.positions[curve.verts[i]];
    const Vec3& b = surface.positions[curve.verts[i + 1]];
    Box3 box;
    box.extend(a);
    box.extend(b);
    found.clear();
    reach_tree.find(box, found);
    for (VertId v : found) {
      double t = 0;
      const double d_sq = distance_sq_to_segment(boundary.positions[v], a, b, t);
      const double limit = reach * boundary.edge_length[v];
      if (d_sq >= limit * limit) continue;
      const double arc = curve.arc_length[i] + t * (curve.arc_length[i + 1] - curve.arc_length[i]);
      candidates.push_back({v, d_sq, arc});
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& x, const Candidate& y) {
    return std::tie(x.vert, x.distance_sq, x.arc) < std::tie(y.vert, y.distance_sq, y.arc);
  });
  std::vector<TubeVert> tube;
  for (const Candidate& c : candidates)
    if (tube.empty() || tube.back().vert != c.vert)
      tube.push_back({c.vert, std::sqrt(c.distance_sq) / boundary.edge_length[c.vert], c.arc});
  return tube;
}

}  // namespace hexwright::fitting
