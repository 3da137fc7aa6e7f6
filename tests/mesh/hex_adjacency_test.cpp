#include "hexwright/mesh/hex_adjacency.h"

#include "helpers.h"

namespace hexwright {
namespace {

TEST(HexAdjacency, NeighborsOfABoxMatchItsLattice) {
  const HexMesh mesh = test::box_hex_mesh(3, 4, 5);
  const auto adjacency = compute_hex_neighbors(mesh);
  EXPECT_TRUE(adjacency.non_conforming.empty());
  EXPECT_EQ(adjacency.boundary.size(), 2u * (3 * 4 + 4 * 5 + 5 * 3));
  const auto id = [](int x, int y, int z) { return HexId((z * 4 + y) * 3 + x); };
  EXPECT_EQ(adjacency.neighbor[id(1, 1, 1)],
            (std::array<HexId, 6>{id(0, 1, 1), id(2, 1, 1), id(1, 0, 1), id(1, 2, 1), id(1, 1, 0),
                                  id(1, 1, 2)}));
}

TEST(HexAdjacency, VertexStarsOfABoxHaveTheRightSizes) {
  const HexMesh mesh = test::box_hex_mesh(2, 2, 2);
  const VertToHex vert_to_hex(mesh);
  EXPECT_EQ(vert_to_hex[VertId(13)].size(), 8u);  // the centre
  EXPECT_EQ(vert_to_hex[VertId(0)].size(), 1u);
  for (VertId v : mesh.positions.ids())
    for (const HexCorner& c : vert_to_hex[v])
      EXPECT_EQ(mesh.hexes[c.hex][static_cast<std::size_t>(c.lv)], v);
}

TEST(HexAdjacency, ThreeHexesOnAFaceAreReported) {
  HexMesh mesh = test::box_hex_mesh(2, 1, 1);
  mesh.hexes.push_back(mesh.hexes[HexId(1)]);
  EXPECT_FALSE(compute_hex_neighbors(mesh).non_conforming.empty());
}

TEST(HexMesh, RemoveUnusedVertsKeepsGeometryAndLabels) {
  HexMesh mesh = test::box_hex_mesh(2, 1, 1);
  mesh.labels.corners = {VertId(2)};
  const Vec3 corner = mesh.positions[VertId(2)];
  mesh.hexes = IdVector<HexId, std::array<VertId, 8>>{mesh.hexes[HexId(1)]};
  remove_unused_verts(mesh);
  EXPECT_EQ(mesh.num_verts(), 8u);
  EXPECT_EQ(mesh.positions[mesh.labels.corners[0]], corner);
  EXPECT_FALSE(mesh.find_problem());
}

}  // namespace
}  // namespace hexwright
