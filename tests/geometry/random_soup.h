// Seeded surfaces and brute-force answers for the tests of the geometry module.
#pragma once

#include <numbers>
#include <random>

#include "hexwright/geometry/surface_tree.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright::test {

inline Vec3 random_point(std::mt19937_64& random, double radius = 1) {
  // Not std::uniform_real_distribution, whose values differ between standard libraries.
  const auto one = [&] { return radius * (2 * double(random() >> 11) / double(1ull << 53) - 1); };
  const double x = one(), y = one(), z = one();
  return {x, y, z};
}

/// Triangles of all sizes and shapes, needles and degenerate ones among them.
inline TriMesh random_soup(int num_tris, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  TriMesh soup;
  for (int t = 0; t < num_tris; ++t) {
    const Vec3 at = random_point(random);
    const double size = t % 3 == 0 ? 0.5 : 0.05;
    std::array<Vec3, 3> p{at, at + random_point(random, size), at + random_point(random, size)};
    if (t % 11 == 5) p[2] = p[1] + (p[1] - p[0]) * 1e-9 + random_point(random, 1e-7);
    if (t % 17 == 3) p[2] = p[0];
    std::array<VertId, 3> tri;
    for (int k = 0; k < 3; ++k) tri[std::size_t(k)] = soup.positions.push_back(p[std::size_t(k)]);
    soup.tris.push_back(tri);
  }
  return soup;
}

inline Vec3 closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double length_sq = norm_sq(b - a);
  const double s = length_sq > 0 ? std::clamp(dot(p - a, b - a) / length_sq, 0.0, 1.0) : 0;
  return a + (b - a) * s;
}

/// Distance by another route than the library's: projection if it falls inside, else the sides.
inline double brute_distance(const Vec3& p, const std::array<Vec3, 3>& c) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k)
    best = std::min(best, distance(p, closest_on_segment(p, c[k], c[(k + 1) % 3])));
  const Vec3 n = normalized(cross(c[1] - c[0], c[2] - c[0]));
  const Vec3 q = p - n * dot(n, p - c[0]);
  bool is_inside = n != Vec3{};
  for (std::size_t k = 0; k < 3; ++k)
    is_inside = is_inside && dot(cross(c[(k + 1) % 3] - c[k], q - c[k]), n) >= 0;
  return is_inside ? std::min(best, distance(p, q)) : best;
}

inline double brute_winding(const TriMesh& surface, const Vec3& p) {
  double sum = 0;
  for (TriId t : surface.tris.ids()) {
    const auto c = surface.corners(t);
    const Vec3 a = c[0] - p, b = c[1] - p, d = c[2] - p;
    const double la = norm(a), lb = norm(b), ld = norm(d);
    sum += 2 * std::atan2(det(a, b, d),
                          la * lb * ld + dot(a, b) * ld + dot(b, d) * la + dot(d, a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace hexwright::test
