// Curved closed surfaces with sharp edges, for tests.
#pragma once

#include <cmath>
#include <numbers>

#include "hexwright/mesh/tri_mesh.h"

namespace hexwright::test {

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
