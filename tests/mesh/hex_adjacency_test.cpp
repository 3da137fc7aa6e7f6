#include "hexwright/mesh/hex_adjacency.h"

#include <random>

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

/// Faces, in order of (hex, lf), by the number of hexes with the same four vertices.
std::vector<HexFace> faces_shared_by(const HexMesh& mesh, bool (*is_wanted)(std::ptrdiff_t)) {
  std::vector<std::array<VertId, 4>> keys;
  for (HexId h : mesh.hexes.ids())
    for (int lf = 0; lf < 6; ++lf) {
      keys.push_back(face_verts(mesh, {h, lf}));
      std::sort(keys.back().begin(), keys.back().end());
    }
  std::vector<HexFace> faces;
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (is_wanted(std::count(keys.begin(), keys.end(), keys[i])))
      faces.push_back({HexId(i / 6), static_cast<int>(i % 6)});
  return faces;
}

bool same_faces(const std::vector<HexFace>& a, const std::vector<HexFace>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const HexFace& x, const HexFace& y) {
    return x.hex == y.hex && x.lf == y.lf;
  });
}

TEST(HexAdjacency, AgreesWithBruteForceOnTangledHexes) {
  std::mt19937 random(11);
  for (int round = 0; round < 20; ++round) {
    HexMesh mesh = test::box_hex_mesh(2, 2, 3);
    // Doubled, rotated and torn hexes, and vertex ids in another order.
    for (HexId h : {HexId(1), HexId(4), HexId(4)}) mesh.hexes.push_back(mesh.hexes[h]);
    for (auto& hex : mesh.hexes)
      if (random() % 4 == 0) std::rotate(hex.begin(), hex.begin() + 4, hex.end());
    mesh.hexes[HexId(random() % 12)][random() % 8] = VertId(random() % 36);
    std::vector<VertId> renamed;
    for (VertId v : mesh.positions.ids()) renamed.push_back(v);
    std::shuffle(renamed.begin(), renamed.end(), random);
    for (auto& hex : mesh.hexes)
      for (VertId& v : hex) v = renamed[v.index()];
    const HexNeighbors found = compute_hex_neighbors(mesh);
    EXPECT_TRUE(
        same_faces(found.boundary, faces_shared_by(mesh, [](std::ptrdiff_t n) { return n == 1; })));
    EXPECT_TRUE(same_faces(found.non_conforming,
                           faces_shared_by(mesh, [](std::ptrdiff_t n) { return n > 2; })));
    std::size_t num_matched = 0;
    for (HexId h : mesh.hexes.ids())
      for (std::size_t lf = 0; lf < 6; ++lf) {
        const HexId other = found.neighbor[h][lf];
        if (!other.is_valid()) continue;
        ++num_matched;
        const auto& back = found.neighbor[other];
        EXPECT_NE(std::find(back.begin(), back.end(), h), back.end());
      }
    EXPECT_EQ(num_matched, faces_shared_by(mesh, [](std::ptrdiff_t n) { return n == 2; }).size());
  }
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
