// Self-checks of the three mesh types: every kind of damage is found and named.
#include <functional>

#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/mesh/tet_mesh.h"
#include "hexwright/mesh/tri_mesh.h"

#include "helpers.h"

namespace hexwright {
namespace {

HexMesh labelled() {
  HexMesh mesh = test::box_hex_mesh(2, 2, 1);
  mesh.region = IdVector<HexId, std::int32_t>(mesh.num_hexes(), 3);
  mesh.labels.quads.push_back({{VertId(0), VertId(3), VertId(4), VertId(1)}, PatchId(0)});
  mesh.labels.edges.push_back({{VertId(0), VertId(1)}, CurveId(2)});
  mesh.labels.corners = {VertId(0), VertId(2)};
  return mesh;
}

TEST(HexMesh, EveryDamageIsNamed) {
  EXPECT_FALSE(labelled().find_problem());
  const struct {
    const char* about;
    std::function<void(HexMesh&)> damage;
  } cases[] = {
      {"hex 2 uses vertex 99", [](HexMesh& m) { m.hexes[HexId(2)][5] = VertId(99); }},
      {"hex 3 uses vertex -1", [](HexMesh& m) { m.hexes[HexId(3)][0] = VertId(); }},
      {"hex 0 uses vertex 18", [](HexMesh& m) { m.hexes[HexId(0)][7] = VertId(m.num_verts()); }},
      {"region", [](HexMesh& m) { m.region.resize(3); }},
      {"patch 1 has no entry among the 1 names",
       [](HexMesh& m) {
         m.labels.quads[0].patch = PatchId(1);
         m.labels.patch_names = {"inlet"};
       }},
      {"curve 2 has no entry among the 2 names",
       [](HexMesh& m) {
         m.labels.curve_names = {"a", "b"};
       }},
      {"quad", [](HexMesh& m) { m.labels.quads[0].verts[3] = VertId(18); }},
      {"edge", [](HexMesh& m) { m.labels.edges[0].verts[1] = VertId(); }},
      {"corner", [](HexMesh& m) { m.labels.corners[1] = VertId(18); }},
      {"vertex 7", [](HexMesh& m) { m.positions[VertId(7)].z = std::nan(""); }},
      {"vertex 9", [](HexMesh& m) { m.positions[VertId(9)].x = -INFINITY; }},
  };
  for (const auto& c : cases) {
    HexMesh mesh = labelled();
    c.damage(mesh);
    const auto issue = mesh.find_problem();
    ASSERT_TRUE(issue) << c.about;
    EXPECT_NE(issue->message.find(c.about), std::string::npos) << issue->message;
  }
}

TEST(TriMesh, IndicesAndPositionsAreChecked) {
  TriMesh cube = test::unit_cube_surface();
  EXPECT_FALSE(cube.find_problem());
  cube.tris[TriId(4)][1] = VertId(8);
  EXPECT_NE(cube.find_problem()->message.find("triangle 4 uses vertex 8 of 8"), std::string::npos);
  cube = test::unit_cube_surface();
  cube.positions[VertId(3)].y = INFINITY;
  EXPECT_NE(cube.find_problem()->message.find("vertex 3"), std::string::npos);
}

TEST(TriMesh, GroupsAreChecked) {
  TriMesh cube = test::unit_cube_surface();
  cube.group_names = {"inlet"};
  cube.group.assign(12, -1);
  EXPECT_FALSE(cube.find_problem());
  cube.group[TriId(7)] = 1;
  EXPECT_NE(cube.find_problem()->message.find("triangle 7 is in group 1 of 1"), std::string::npos);
  cube.group.resize(11);
  EXPECT_NE(cube.find_problem()->message.find("groups"), std::string::npos);
}

TEST(HexMesh, NamesNeedNotBeThere) {
  HexMesh mesh = labelled();
  mesh.labels.patch_names = {"inlet"};
  mesh.labels.curve_names = {"", "", "rim"};
  mesh.region_names = {"steel"};
  EXPECT_FALSE(mesh.find_problem());
  mesh.labels.quads[0].patch = PatchId();
  EXPECT_FALSE(mesh.find_problem());
}

TEST(TetMesh, IndicesAndPositionsAreChecked) {
  TetMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{VertId(0), VertId(1), VertId(2), VertId(3)}};
  EXPECT_FALSE(mesh.find_problem());
  mesh.tets[TetId(0)][2] = VertId(4);
  EXPECT_NE(mesh.find_problem()->message.find("tetrahedron 0"), std::string::npos);
}

TEST(BoundingBox, IgnoresVerticesThatNothingUses) {
  TriMesh cube = test::unit_cube_surface();
  cube.positions.push_back({1e9, std::nan(""), 0});
  EXPECT_EQ(bounding_box(cube).hi, (Vec3{1, 1, 1}));
  HexMesh box = test::box_hex_mesh(2, 3, 4);
  box.positions.push_back({-7, 0, 0});
  EXPECT_EQ(bounding_box(box).lo, Vec3{});
  EXPECT_EQ(bounding_box(box).hi, (Vec3{2, 3, 4}));
  EXPECT_TRUE(bounding_box(TriMesh{}).is_empty());
}

}  // namespace
}  // namespace hexwright
