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
#include <numbers>

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

/// Length along the ray from p in direction d to the triangle, negative when it is not met. A
/// little is added to the triangle's edges, so that rounding leaves no gap between two that share
/// one.
///
/// Based on: Moeller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of
/// Graphics Tools 2(1), 1997.
inline double ray_length(const TriangleData& t, const Vec3& p, const Vec3& d) {
  constexpr double kMargin = 1e-12;
  const Vec3 h = cross(d, t.ac);
  const double volume = dot(t.ab, h);
  if (volume == 0) return -1;  // along the plane, or no area
  const double inverse = 1 / volume;
  const Vec3 s = p - t.a;
  const double u = dot(s, h) * inverse;
  if (!(u >= -kMargin && u <= 1 + kMargin)) return -1;
  const Vec3 q = cross(s, t.ab);
  const double v = dot(d, q) * inverse;
  if (!(v >= -kMargin && u + v <= 1 + kMargin)) return -1;
  return dot(t.ac, q) * inverse;
}

/// Sums half the solid angles of triangles a, b, c seen from the origin, each in -pi .. pi and
/// positive when the origin is behind the triangle. Half an angle is the argument of a complex
/// number (denominator + i numerator), and arguments add up when numbers are multiplied: one arc
/// tangent in the end serves all triangles, which would take half of the time. Turns past +-pi are
/// counted.
class HalfAngleSum {
 public:
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double la = norm(a), lb = norm(b), lc = norm(c);
    const double numerator = det(a, b, c);
    // In the triangle's own plane the angle jumps: both one-sided limits average to zero.
    if (numerator == 0) return;
    const double denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    const double scale = 1 / (std::abs(numerator) + std::abs(denominator));
    multiply(denominator * scale, numerator * scale);
  }
  double value() const { return 2 * std::numbers::pi * turns_ + std::atan2(im_, re_); }

 private:
  void multiply(double re, double im) {
    const double new_re = re_ * re - im_ * im, new_im = re_ * im + im_ * re;
    // An angle in 0 .. pi takes one that is not negative past pi, or leaves it not negative.
    if (im > 0 && im_ >= 0 && new_im < 0) ++turns_;
    if (im < 0 && im_ < 0 && new_im >= 0) --turns_;
    re_ = new_re;
    im_ = new_im;
    // Factors have lengths in 0.7 .. 1: long products must not vanish.
    if (std::abs(re_) + std::abs(im_) < 1e-100) {
      re_ *= 1e100;
      im_ *= 1e100;
    }
  }

  double re_ = 1, im_ = 0;
  int turns_ = 0;
};

}  // namespace hexwright
