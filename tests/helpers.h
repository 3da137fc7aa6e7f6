// Small named meshes and paths shared by the tests.
#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright::test {

/// A file bundled with the project, under data/.
inline std::filesystem::path bundled(const std::string& name) {
  return std::filesystem::path(HEXWRIGHT_SOURCE_DIR) / "data" / name;
}

/// The shared collection beside the project (models, baseline grids); absent on most machines.
inline std::filesystem::path shared_dir() {
  return std::filesystem::path(HEXWRIGHT_SOURCE_DIR).parent_path() / "shared";
}

#define HEXWRIGHT_SKIP_WITHOUT_SHARED()                                        \
  if (!std::filesystem::exists(hexwright::test::shared_dir()))                 \
  GTEST_SKIP() << "needs the shared collection of models beside the project (" \
               << hexwright::test::shared_dir().string() << "), which is not on this machine"

/// The unit cube [0,1]^3 as 12 outward triangles.
inline TriMesh unit_cube_surface() {
  TriMesh cube;
  for (int b = 0; b < 8; ++b)
    cube.positions.push_back({double(b & 1), double(b >> 1 & 1), double(b >> 2 & 1)});
  const auto quad = [&](int a, int b, int c, int d) {
    cube.tris.push_back({VertId(a), VertId(b), VertId(c)});
    cube.tris.push_back({VertId(a), VertId(c), VertId(d)});
  };
  quad(0, 4, 6, 2);
  quad(1, 3, 7, 5);
  quad(0, 1, 5, 4);
  quad(2, 6, 7, 3);
  quad(0, 2, 3, 1);
  quad(4, 5, 7, 6);
  return cube;
}

/// A sphere: an octahedron subdivided `depth` times and projected to radius 1 about the origin.
inline TriMesh unit_sphere_surface(int depth) {
  TriMesh s;
  for (int a = 0; a < 3; ++a)
    for (double sign : {1.0, -1.0}) {
      Vec3 p;
      p[a] = sign;
      s.positions.push_back(p);
    }
  for (int x : {0, 1})
    for (int y : {2, 3})
      for (int z : {4, 5}) {
        const bool flip = ((x & 1) + (y & 1) + (z & 1)) % 2 == 1;
        s.tris.push_back({VertId(x), VertId(flip ? z : y), VertId(flip ? y : z)});
      }
  for (int k = 0; k < depth; ++k) {
    TriMesh fine;
    for (TriId t : s.tris.ids()) {
      const auto p = s.corners(t);
      const Vec3 q[6] = {p[0],
                         p[1],
                         p[2],
                         normalized(p[0] + p[1]),
                         normalized(p[1] + p[2]),
                         normalized(p[2] + p[0])};
      const int base = static_cast<int>(fine.num_verts());
      for (const Vec3& x : q) fine.positions.push_back(x);
      const auto tri = [&](int a, int b, int c) {
        fine.tris.push_back({VertId(base + a), VertId(base + b), VertId(base + c)});
      };
      tri(0, 3, 5);
      tri(3, 1, 4);
      tri(5, 4, 2);
      tri(3, 4, 5);
    }
    s = fine;
  }
  return s;  // unwelded: every triangle has its own vertices when depth > 0
}

/// A box of nx x ny x nz unit hexes at the origin.
inline HexMesh box_hex_mesh(int nx, int ny, int nz) {
  HexMesh m;
  const auto id = [&](int x, int y, int z) { return VertId((z * (ny + 1) + y) * (nx + 1) + x); };
  for (int z = 0; z <= nz; ++z)
    for (int y = 0; y <= ny; ++y)
      for (int x = 0; x <= nx; ++x) m.positions.push_back({double(x), double(y), double(z)});
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        m.hexes.push_back({id(x, y, z), id(x + 1, y, z), id(x + 1, y + 1, z), id(x, y + 1, z),
                           id(x, y, z + 1), id(x + 1, y, z + 1), id(x + 1, y + 1, z + 1),
                           id(x, y + 1, z + 1)});
  return m;
}

}  // namespace hexwright::test
