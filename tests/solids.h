// Closed surfaces with sharp edges, and several as one, for tests.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "hexwright/mesh/tri_mesh.h"

#include "helpers.h"
#include "mesh/tri_measures.h"

namespace hexwright::test {

/// A box of two triangles per side.
inline TriMesh box_surface(const Vec3& lo, const Vec3& hi) {
  TriMesh box = unit_cube_surface();
  for (Vec3& p : box.positions)
    p = {lo.x + p.x * (hi.x - lo.x), lo.y + p.y * (hi.y - lo.y), lo.z + p.z * (hi.z - lo.z)};
  return box;
}

/// Inside out.
inline TriMesh reversed(TriMesh surface) {
  for (auto& t : surface.tris) std::swap(t[1], t[2]);
  return surface;
}

/// Several surfaces as one, as in a file: unwelded, without names.
inline TriMesh joined(const std::vector<TriMesh>& parts) {
  TriMesh all;
  for (const TriMesh& part : parts) append(all, part);
  return all;
}

/// A closed cylinder along z about (x, y) = (center, center).
inline TriMesh cylinder_surface(double center, double radius, double z0, double z1, int segments) {
  TriMesh s;
  for (double z : {z0, z1})
    for (int k = 0; k < segments; ++k) {
      const double a = 2 * std::numbers::pi * k / segments;
      s.positions.push_back({center + radius * std::cos(a), center + radius * std::sin(a), z});
    }
  const VertId bottom = s.positions.push_back({center, center, z0});
  const VertId top = s.positions.push_back({center, center, z1});
  for (int k = 0; k < segments; ++k) {
    const int next = (k + 1) % segments;
    const VertId a(k), b(next), c(segments + next), d(segments + k);
    s.tris.push_back({a, b, c});
    s.tris.push_back({a, c, d});
    s.tris.push_back({bottom, b, a});
    s.tris.push_back({top, d, c});
  }
  return s;
}

}  // namespace hexwright::test
