// Closest point on a triangle and the solid angle of one, the kernels of the surface tree.
//
// Based on: Ericson, "Real-Time Collision Detection", 2005, section 5.1.5 (closest point by Voronoi
// regions); van Oosterom, Strackee, "The Solid Angle of a Plane Triangle", IEEE Trans. Biomed. Eng.
// 30, 1983, equation 8.
// Differs: edge products are stored per triangle, so that a query costs two dot products and the
// region tests.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "hexwright/base/vec3.h"

namespace hexwright {

/// Unit normal by orientation, zero for a triangle without area. Scaled first, so that neither tiny
/// nor huge triangles lose their normal.
inline Vec3 unit_normal(const std::array<Vec3, 3>& c) {
  const Vec3 ab = c[1] - c[0], ac = c[2] - c[0];
  const double size = std::max({std::abs(ab.x), std::abs(ab.y), std::abs(ab.z), std::abs(ac.x),
                                std::abs(ac.y), std::abs(ac.z)});
  if (!(size > 0)) return {};
  return normalized(cross(ab / size, ac / size));
}

/// One triangle as the queries want it.
struct TriangleData {
  Vec3 a, ab, ac;           ///< first corner and the edges from it
  double abab, abac, acac;  ///< products of the edges
  Vec3 normal;              ///< unit, or zero when degenerate

  static TriangleData make(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
    const Vec3 ab = b - a, ac = c - a;
    return {a, ab, ac, dot(ab, ab), dot(ab, ac), dot(ac, ac), normal};
  }
};

/// Vector from a to the point of the triangle nearest to a + ap.
inline Vec3 closest_offset(const TriangleData& t, const Vec3& ap) {
  const double d1 = dot(t.ab, ap), d2 = dot(t.ac, ap);
  if (d1 <= 0 && d2 <= 0) return {};
  const double d3 = d1 - t.abab, d4 = d2 - t.abac;  // products with p - b
  if (d3 >= 0 && d4 <= d3) return t.ab;
  const double d5 = d1 - t.abac, d6 = d2 - t.acac;  // products with p - c
  if (d6 >= 0 && d5 <= d6) return t.ac;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && t.abab > 0) return t.ab * (d1 / t.abab);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0 && t.acac > 0) return t.ac * (d2 / t.acac);
  const double va = d3 * d6 - d5 * d4;
  const double along_b = d4 - d3, along_c = d5 - d6;
  if (va <= 0 && along_b >= 0 && along_c >= 0 && along_b + along_c > 0)
    return t.ab + (t.ac - t.ab) * (along_b / (along_b + along_c));
  const double inverse = 1 / (va + vb + vc);
  return t.ab * (vb * inverse) + t.ac * (vc * inverse);
}

/// Half the solid angle (in -pi .. pi) of triangle a, b, c seen from the origin; positive when the
/// origin is behind it.
inline double half_solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = norm(a), lb = norm(b), lc = norm(c);
  const double numerator = det(a, b, c);
  const double denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  // In the triangle's own plane the angle jumps: both one-sided limits average to zero.
  return numerator == 0 ? 0 : std::atan2(numerator, denominator);
}

}  // namespace hexwright
