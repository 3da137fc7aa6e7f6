#include "hexwright/mesh/cut_hexes.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "helpers.h"

namespace hexwright {
namespace {

double tet_volume(const TetMesh& mesh, TetId t) {
  const auto& v = mesh.tets[t];
  const Vec3& o = mesh.positions[v[0]];
  return det(mesh.positions[v[1]] - o, mesh.positions[v[2]] - o, mesh.positions[v[3]] - o) / 6;
}

TEST(CutHexes, TetsArePositiveAndFillTheHexes) {
  const HexMesh box = test::box_hex_mesh(3, 2, 2);
  const TetMesh tets = cut_hexes(box);
  ASSERT_EQ(tets.num_tets(), kTetsPerHex * 12);
  EXPECT_FALSE(tets.find_problem());
  for (HexId h : box.hexes.ids()) {
    double sum = 0;
    for (std::size_t k = 0; k < kTetsPerHex; ++k) {
      const double volume = tet_volume(tets, TetId(kTetsPerHex * h.index() + k));
      EXPECT_GT(volume, 0);
      sum += volume;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
  for (VertId v : box.positions.ids()) EXPECT_EQ(tets.positions[v], box.positions[v]);
  // 12 hexes, 4 * 4 + 3 * 6 + 3 * 6 faces.
  EXPECT_EQ(tets.num_verts(), box.num_verts() + 12 + 52);
}

TEST(CutHexes, FacetsMeetInPairsInside) {
  const TetMesh tets = cut_hexes(test::box_hex_mesh(2, 2, 1));
  std::map<std::set<VertId>, int> count;
  for (const auto& tet : tets.tets)
    for (std::size_t k = 0; k < 4; ++k) {
      std::set<VertId> facet(tet.begin(), tet.end());
      facet.erase(tet[k]);
      ++count[facet];
    }
  std::size_t num_single = 0;
  for (const auto& [facet, n] : count) {
    EXPECT_LE(n, 2);
    num_single += n == 1;
  }
  EXPECT_EQ(num_single, 4u * 16);  // boundary quads of the box, four facets each
}

// Which tets there are follows from the hexes alone.
TEST(CutHexes, PlacesDoNotMatter) {
  HexMesh box = test::box_hex_mesh(3, 2, 2);
  const TetMesh straight = cut_hexes(box);
  for (Vec3& p : box.positions) p = {p.y + p.z * p.z, p.x * 3, -p.z};
  EXPECT_EQ(cut_hexes(box).tets, straight.tets);
}

}  // namespace
}  // namespace hexwright
