// Surfaces and background meshes for the tests of carving and fitting.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <random>

#include "helpers.h"

namespace hexwright::test {

/// Merges vertices with equal coordinates.
inline TriMesh welded(const TriMesh& soup) {
  TriMesh result;
  std::map<std::array<double, 3>, VertId> known;
  for (const auto& tri : soup.tris) {
    std::array<VertId, 3> out;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = soup.positions[tri[k]];
      auto [slot, is_new] = known.try_emplace({p.x, p.y, p.z}, VertId(result.num_verts()));
      if (is_new) result.positions.push_back(p);
      out[k] = slot->second;
    }
    result.tris.push_back(out);
  }
  return result;
}

inline TriMesh torus_surface(double major, double minor, int around, int across) {
  TriMesh t;
  constexpr double kTurn = 6.283185307179586;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = kTurn * i / around, v = kTurn * j / across;
      const double r = major + minor * std::cos(v);
      t.positions.push_back({r * std::cos(u), r * std::sin(u), minor * std::sin(v)});
    }
  const auto id = [&](int i, int j) { return VertId(i % around * across + j % across); };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      t.tris.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      t.tris.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return t;
}

/// A rotation drawn uniformly (by a random unit quaternion).
inline TriMesh randomly_rotated(TriMesh surface, std::mt19937& rng) {
  std::normal_distribution<double> normal;
  double q[4], length = 0;
  for (double& x : q) x = normal(rng);
  for (double x : q) length += x * x;
  for (double& x : q) x /= std::sqrt(length);
  const Vec3 axis{q[1], q[2], q[3]};
  for (Vec3& p : surface.positions) {
    const Vec3 t = 2.0 * cross(axis, p);
    p = p + q[0] * t + cross(axis, t);
  }
  return surface;
}

/// Cubes of edge `h` that cover a box with two to spare on each side, off its symmetry planes.
inline HexMesh grid_around(const Box3& box, double h) {
  int n[3];
  for (int k = 0; k < 3; ++k) n[k] = static_cast<int>(std::ceil(box.extent()[k] / h)) + 4;
  HexMesh mesh = box_hex_mesh(n[0], n[1], n[2]);
  const Vec3 origin = box.center() - 0.5 * h * Vec3{double(n[0]), double(n[1]), double(n[2])} +
                      Vec3{0.137 * h, 0.071 * h, 0.113 * h};
  for (Vec3& p : mesh.positions) p = origin + h * p;
  return mesh;
}

}  // namespace hexwright::test
