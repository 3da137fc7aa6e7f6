// Queries on one feature curve: nearest point in a window of arc length, point at an arc length.
#include <algorithm>
#include <cmath>
#include <limits>

#include "hexwright/geometry/feature_graph.h"

namespace hexwright {
namespace {

Vec3 vert_at(const TriMesh& surface, const FeatureCurve& curve, std::size_t i) {
  return surface.positions[curve.verts[i]];
}

/// Unit direction of segment i (from vertex i to i + 1), zero when it has no length.
Vec3 direction(const TriMesh& surface, const FeatureCurve& curve, std::size_t i) {
  return normalized(vert_at(surface, curve, i + 1) - vert_at(surface, curve, i));
}

/// The tangent at parameter s in [0, 1] of segment i; at a vertex the mean of both sides.
Vec3 tangent_at(const TriMesh& surface, const FeatureCurve& curve, std::size_t i, double s) {
  constexpr double kAtVertex = 1e-9;
  const std::size_t num_segments = curve.verts.size() - 1;
  const Vec3 here = direction(surface, curve, i);
  Vec3 other;
  if (s >= 1 - kAtVertex) {
    if (i + 1 < num_segments)
      other = direction(surface, curve, i + 1);
    else if (curve.is_closed)
      other = direction(surface, curve, 0);
  } else if (s <= kAtVertex) {
    if (i > 0)
      other = direction(surface, curve, i - 1);
    else if (curve.is_closed)
      other = direction(surface, curve, num_segments - 1);
  }
  const Vec3 mean = normalized(here + other);
  return mean == Vec3{} ? here : mean;
}

/// The segment that holds an arc length: the first whose end is not before it.
std::size_t segment_of(const FeatureCurve& curve, double arc) {
  const auto& s = curve.arc_length;
  const auto it = std::lower_bound(s.begin() + 1, s.end() - 1, arc);
  return static_cast<std::size_t>(it - s.begin()) - 1;
}

/// The best so far of a scan; the lower segment wins among equals.
struct Nearest {
  double distance_sq = std::numeric_limits<double>::infinity();
  std::size_t segment = 0;
  double s = 0;  ///< parameter in the segment
};

/// Scans the segments that meet [lo, hi], which lies in [0, length]; each is clipped to the window.
void scan(const TriMesh& surface, const FeatureCurve& curve, const Vec3& p, double lo, double hi,
          Nearest& best) {
  const auto& arc = curve.arc_length;
  for (std::size_t i = segment_of(curve, lo); i + 1 < arc.size(); ++i) {
    const double step = arc[i + 1] - arc[i];
    const double s_lo = step > 0 ? std::clamp((lo - arc[i]) / step, 0.0, 1.0) : 0;
    const double s_hi = step > 0 ? std::clamp((hi - arc[i]) / step, 0.0, 1.0) : 0;
    const Vec3 a = vert_at(surface, curve, i);
    const Vec3 d = vert_at(surface, curve, i + 1) - a;
    const double dd = dot(d, d);
    const double s = std::clamp(dd > 0 ? dot(p - a, d) / dd : 0, s_lo, s_hi);
    const double distance_sq = norm_sq(a + d * s - p);
    if (distance_sq < best.distance_sq) best = {distance_sq, i, s};
    if (arc[i + 1] >= hi) break;
  }
}

CurvePoint to_point(const TriMesh& surface, const FeatureCurve& curve, const Nearest& n) {
  const Vec3 a = vert_at(surface, curve, n.segment), b = vert_at(surface, curve, n.segment + 1);
  const double arc_a = curve.arc_length[n.segment], arc_b = curve.arc_length[n.segment + 1];
  return {n.s == 1 ? b : a + (b - a) * n.s, tangent_at(surface, curve, n.segment, n.s),
          arc_a + (arc_b - arc_a) * n.s, n.distance_sq};
}

/// A curve of one vertex or without length is that vertex; an empty one is infinitely far.
CurvePoint degenerate_point(const TriMesh& surface, const FeatureCurve& curve, const Vec3& p) {
  if (curve.verts.empty()) return {{}, {}, 0, std::numeric_limits<double>::infinity()};
  const Vec3 q = vert_at(surface, curve, 0);
  return {q, {}, 0, norm_sq(q - p)};
}

/// Into [0, length).
double wrapped(double arc, double length) {
  const double r = std::fmod(arc, length);
  return r < 0 ? r + length : r;
}

}  // namespace

CurvePoint closest_on_curve(const TriMesh& surface, const FeatureCurve& curve, const Vec3& p) {
  return closest_on_curve(surface, curve, p, 0, curve.length());
}

CurvePoint closest_on_curve(const TriMesh& surface, const FeatureCurve& curve, const Vec3& p,
                            double arc_lo, double arc_hi) {
  const double length = curve.length();
  if (curve.verts.size() < 2 || !(length > 0)) return degenerate_point(surface, curve, p);
  if (arc_hi < arc_lo) arc_hi = arc_lo;
  Nearest best;
  if (!curve.is_closed) {
    scan(surface, curve, p, std::clamp(arc_lo, 0.0, length), std::clamp(arc_hi, 0.0, length), best);
  } else if (!(arc_hi - arc_lo < length)) {
    scan(surface, curve, p, 0, length, best);
  } else {
    const double lo = wrapped(arc_lo, length), hi = lo + (arc_hi - arc_lo);
    scan(surface, curve, p, lo, std::min(hi, length), best);
    if (hi > length) scan(surface, curve, p, 0, hi - length, best);
  }
  return to_point(surface, curve, best);
}

CurvePoint point_at_arc(const TriMesh& surface, const FeatureCurve& curve, double arc) {
  const double length = curve.length();
  if (curve.verts.size() < 2 || !(length > 0)) {
    CurvePoint point = degenerate_point(surface, curve, {});
    point.distance_sq = 0;
    return point;
  }
  arc = curve.is_closed ? wrapped(arc, length) : std::clamp(arc, 0.0, length);
  Nearest at;
  at.distance_sq = 0;
  at.segment = segment_of(curve, arc);
  const double start = curve.arc_length[at.segment];
  const double step = curve.arc_length[at.segment + 1] - start;
  at.s = step > 0 ? std::clamp((arc - start) / step, 0.0, 1.0) : 0;
  return to_point(surface, curve, at);
}

}  // namespace hexwright
