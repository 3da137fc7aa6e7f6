// Tetrahedral polycubes for tests: chosen unit cubes of a lattice, six tets each.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "hexwright/grid/grid.h"
#include "hexwright/mesh/tet_mesh.h"

namespace hexwright::test {

/// Each cube is cut `cuts` times per axis, then into six tets around its main diagonal (Kuhn).
inline TetMesh tet_cubes(const std::vector<LatticeCoord>& cubes, int cuts) {
  TetMesh mesh;
  std::map<LatticeCoord, VertId> ids;
  const auto vert = [&](const LatticeCoord& p) {
    auto [it, is_new] = ids.try_emplace(p);
    if (is_new)
      it->second =
          mesh.positions.push_back({p[0] / double(cuts), p[1] / double(cuts), p[2] / double(cuts)});
    return it->second;
  };
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (const auto& cube : cubes)
    for (int c = 0; c < cuts * cuts * cuts; ++c) {
      const LatticeCoord lo = {cube[0] * cuts + c % cuts, cube[1] * cuts + c / cuts % cuts,
                               cube[2] * cuts + c / cuts / cuts};
      for (int k = 0; k < 6; ++k) {
        LatticeCoord p = lo;
        std::array<VertId, 4> tet;
        tet[0] = vert(p);
        for (int step = 0; step < 3; ++step) {
          ++p[static_cast<std::size_t>(kOrders[k][step])];
          tet[static_cast<std::size_t>(step) + 1] = vert(p);
        }
        if (k >= 3) std::swap(tet[2], tet[3]);  // odd permutations are mirrored
        mesh.tets.push_back(tet);
      }
    }
  return mesh;
}

inline TetMesh mapped(TetMesh mesh, const std::function<Vec3(Vec3)>& map) {
  for (Vec3& p : mesh.positions) p = map(p);
  return mesh;
}

}  // namespace hexwright::test
