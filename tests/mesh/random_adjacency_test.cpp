// Adjacency against the obvious quadratic search, on boxes with random hexes taken out, doubled,
// renumbered and turned.
#include <algorithm>
#include <random>

#include "hexwright/mesh/hex_adjacency.h"

#include "helpers.h"

namespace hexwright {
namespace {

/// Turns a hex about its own z axis: the same cube under other local numbers.
std::array<VertId, 8> turned(const std::array<VertId, 8>& v, std::size_t quarter) {
  std::array<VertId, 8> out;
  for (std::size_t i = 0; i < 4; ++i) {
    out[i] = v[(i + quarter) % 4];
    out[4 + i] = v[4 + (i + quarter) % 4];
  }
  return out;
}

HexMesh random_mesh(unsigned seed) {
  std::mt19937 random(seed);
  const HexMesh box = test::box_hex_mesh(4, 3, 3);
  HexMesh mesh;
  mesh.positions = box.positions;
  for (const auto& hex : box.hexes) {
    if (random() % 4 == 0) continue;
    mesh.hexes.push_back(turned(hex, random() % 4));
    if (random() % 12 == 0) mesh.hexes.push_back(turned(hex, random() % 4));  // lies on its twin
  }
  std::shuffle(mesh.hexes.begin(), mesh.hexes.end(), random);
  return mesh;
}

std::array<VertId, 4> sorted_face(const HexMesh& mesh, HexFace face) {
  auto verts = face_verts(mesh, face);
  std::sort(verts.begin(), verts.end());
  return verts;
}

std::vector<HexFace> others_on_face(const HexMesh& mesh, HexFace face) {
  std::vector<HexFace> others;
  for (HexId h : mesh.hexes.ids())
    for (int lf = 0; lf < 6; ++lf)
      if (!(HexFace{h, lf} == face) && sorted_face(mesh, {h, lf}) == sorted_face(mesh, face))
        others.push_back({h, lf});
  return others;
}

bool contains(const std::vector<HexFace>& list, HexFace face) {
  return std::find(list.begin(), list.end(), face) != list.end();
}

TEST(HexAdjacency, NeighborsAgreeWithBruteForce) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const HexMesh mesh = random_mesh(seed);
    const HexNeighbors adjacency = compute_hex_neighbors(mesh);
    std::size_t num_alone = 0, num_crowded = 0;
    for (HexId h : mesh.hexes.ids())
      for (int lf = 0; lf < 6; ++lf) {
        const HexFace face{h, lf};
        const auto others = others_on_face(mesh, face);
        const HexId found = adjacency.neighbor[h][static_cast<std::size_t>(lf)];
        EXPECT_EQ(found, others.size() == 1 ? others[0].hex : HexId()) << "seed " << seed;
        EXPECT_EQ(contains(adjacency.boundary, face), others.empty()) << "seed " << seed;
        EXPECT_EQ(contains(adjacency.non_conforming, face), others.size() > 1) << "seed " << seed;
        num_alone += others.empty();
        num_crowded += others.size() > 1;
      }
    EXPECT_EQ(adjacency.boundary.size(), num_alone);
    EXPECT_EQ(adjacency.non_conforming.size(), num_crowded);
    EXPECT_GT(num_alone, 0u);
  }
}

TEST(HexAdjacency, VertexStarsAgreeWithBruteForce) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const HexMesh mesh = random_mesh(seed);
    const VertToHex vert_to_hex(mesh);
    for (VertId v : mesh.positions.ids()) {
      std::vector<std::pair<int, int>> expected, found;
      for (HexId h : mesh.hexes.ids())
        for (std::size_t lv = 0; lv < 8; ++lv)
          if (mesh.hexes[h][lv] == v) expected.emplace_back(h.value(), static_cast<int>(lv));
      for (const HexCorner& c : vert_to_hex[v]) found.emplace_back(c.hex.value(), c.lv);
      EXPECT_EQ(found, expected) << "seed " << seed << ", vertex " << v.value();
    }
  }
}

TEST(HexAdjacency, FaceVertsSeeTheHexFromOutside) {
  const HexMesh mesh = random_mesh(3);
  for (HexId h : mesh.hexes.ids()) {
    Vec3 center;
    for (const Vec3& p : mesh.corners(h)) center += p / 8;
    for (int lf = 0; lf < 6; ++lf) {
      const auto v = face_verts(mesh, {h, lf});
      const Vec3 &a = mesh.positions[v[0]], &b = mesh.positions[v[1]], &c = mesh.positions[v[2]];
      EXPECT_GT(dot(cross(b - a, c - a), a - center), 0);
    }
  }
}

TEST(HexAdjacency, RemovingUnusedVerticesIsIdempotentAndKeepsEveryHex) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    HexMesh mesh = random_mesh(seed);
    std::vector<std::array<Vec3, 8>> before;
    for (HexId h : mesh.hexes.ids()) before.push_back(mesh.corners(h));
    remove_unused_verts(mesh);
    for (HexId h : mesh.hexes.ids()) EXPECT_EQ(mesh.corners(h), before[h.index()]);
    std::vector<char> is_used(mesh.num_verts(), 0);
    for (const auto& hex : mesh.hexes)
      for (VertId v : hex) is_used[v.index()] = 1;
    EXPECT_EQ(std::count(is_used.begin(), is_used.end(), 1), long(mesh.num_verts()));
    const HexMesh once = mesh;
    remove_unused_verts(mesh);
    EXPECT_EQ(mesh.hexes, once.hexes);
    EXPECT_EQ(mesh.positions, once.positions);
  }
}

}  // namespace
}  // namespace hexwright
