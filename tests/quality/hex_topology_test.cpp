#include "hexwright/quality/hex_topology.h"

#include "helpers.h"

namespace hexwright {
namespace {

// The box without some of its hexes.
HexMesh without(HexMesh mesh, std::initializer_list<int> removed) {
  IdVector<HexId, std::array<VertId, 8>> kept;
  for (HexId h : mesh.hexes.ids())
    if (std::find(removed.begin(), removed.end(), h.value()) == removed.end())
      kept.push_back(mesh.hexes[h]);
  mesh.hexes = kept;
  remove_unused_verts(mesh);
  return mesh;
}

// Both meshes side by side, without shared vertices.
HexMesh join(HexMesh a, const HexMesh& b) {
  const int shift = static_cast<int>(a.num_verts());
  for (const Vec3& p : b.positions) a.positions.push_back(p);
  for (auto hex : b.hexes) {
    for (VertId& v : hex) v = VertId(v.value() + shift);
    a.hexes.push_back(hex);
  }
  return a;
}

HexMesh transformed(HexMesh mesh, double scale, const Vec3& shift) {
  for (Vec3& p : mesh.positions) p = scale * p + shift;
  return mesh;
}

bool mentions(const TopologyReport& report, const std::string& text) {
  for (const std::string& problem : report.problems)
    if (problem.find(text) != std::string::npos) return true;
  return false;
}

TEST(HexTopology, ABoxIsABall) {
  const TopologyReport report = check_topology(test::box_hex_mesh(3, 4, 5));
  EXPECT_TRUE(report.is_valid()) << report.problems.front();
  EXPECT_EQ(report.num_components, 1u);
  EXPECT_EQ(report.num_boundary_components, 1u);
  EXPECT_EQ(report.boundary_euler_characteristic, 2);
  EXPECT_EQ(report.genus(), 0);
}

TEST(HexTopology, ARingHasGenusOne) {
  const TopologyReport report = check_topology(without(test::box_hex_mesh(3, 3, 1), {4}));
  EXPECT_TRUE(report.is_valid());
  EXPECT_EQ(report.boundary_euler_characteristic, 0);
  EXPECT_EQ(report.genus(), 1);
}

TEST(HexTopology, ACavityIsASecondBoundaryComponent) {
  const TopologyReport report = check_topology(without(test::box_hex_mesh(3, 3, 3), {13}));
  EXPECT_TRUE(report.is_valid());
  EXPECT_EQ(report.num_components, 1u);
  EXPECT_EQ(report.num_boundary_components, 2u);
  EXPECT_EQ(report.genus(), 0);
}

TEST(HexTopology, SeparateBoxesAreComponents) {
  const HexMesh box = test::box_hex_mesh(2, 1, 1);
  const TopologyReport report = check_topology(join(box, transformed(box, 1, {5, 0, 0})));
  EXPECT_TRUE(report.is_valid());
  EXPECT_EQ(report.num_components, 2u);
}

TEST(HexTopology, NamesAHexWithARepeatedVertex) {
  HexMesh mesh = test::box_hex_mesh(2, 2, 1);
  mesh.hexes[HexId(2)][6] = mesh.hexes[HexId(2)][5];
  const TopologyReport report = check_topology(mesh);
  EXPECT_EQ(report.num_repeated_verts, 1u);
  EXPECT_TRUE(mentions(report, "the first is hex 2"));
}

TEST(HexTopology, NamesAFaceOfThreeHexes) {
  HexMesh mesh = test::box_hex_mesh(2, 1, 1);
  for (double z : {2.0, 3.0})
    for (int i = 0; i < 4; ++i) mesh.positions.push_back({double(i % 2), double(i / 2), z});
  // A third hex on the face x = 1 of the first two.
  auto third = mesh.hexes[HexId(1)];
  for (int lv : {1, 2, 5, 6}) third[lv] = VertId(12 + lv);
  mesh.hexes.push_back(third);
  const TopologyReport report = check_topology(mesh);
  EXPECT_EQ(report.num_nonconforming_faces, 1u);
  EXPECT_TRUE(mentions(report, "three or more hexes"));
}

TEST(HexTopology, NamesMisorientedNeighbors) {
  HexMesh mesh = test::box_hex_mesh(3, 1, 1);
  auto& hex = mesh.hexes[HexId(1)];  // turned inside out: bottom and top exchanged
  for (int lv = 0; lv < 4; ++lv) std::swap(hex[lv], hex[lv + 4]);
  const TopologyReport report = check_topology(mesh);
  EXPECT_EQ(report.num_misoriented_faces, 2u);
  EXPECT_TRUE(mentions(report, "of hex 0"));
}

TEST(HexTopology, AFaceWithCrossedVerticesIsMisoriented) {
  HexMesh mesh = test::box_hex_mesh(2, 1, 1);
  std::swap(mesh.hexes[HexId(1)][0], mesh.hexes[HexId(1)][3]);
  EXPECT_EQ(check_topology(mesh).num_misoriented_faces, 1u);
}

TEST(HexTopology, NamesADoublet) {
  // Two hexes around an edge of valence two: a box whose second hex also takes the first one's top.
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  for (const Vec3& p : {Vec3{2, 0, 2}, Vec3{2, 1, 2}}) mesh.positions.push_back(p);
  // First hex: VTK order 0 1 3 2 | 4 5 7 6. The second shares its faces +x (1 3 7 5), +z (4 5 7 6).
  mesh.hexes.push_back(
      {VertId(1), VertId(8), VertId(9), VertId(3), VertId(5), VertId(4), VertId(6), VertId(7)});
  const TopologyReport report = check_topology(mesh);
  EXPECT_EQ(report.num_doublets, 1u);
  EXPECT_TRUE(mentions(report, "hex 0"));
}

TEST(HexTopology, NamesAnEdgeWhereTwoHexesTouch) {
  const TopologyReport report = check_topology(without(test::box_hex_mesh(2, 2, 1), {1, 2}));
  EXPECT_EQ(report.num_nonmanifold_edges, 1u);
  EXPECT_EQ(report.num_nonmanifold_verts, 2u);  // its ends
  EXPECT_EQ(report.num_components, 2u);
  EXPECT_FALSE(report.is_valid());
}

TEST(HexTopology, NamesAVertexWhereTwoHexesTouch) {
  const TopologyReport report =
      check_topology(without(test::box_hex_mesh(2, 2, 2), {1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(report.num_nonmanifold_edges, 0u);
  EXPECT_EQ(report.num_nonmanifold_verts, 1u);
  EXPECT_EQ(report.num_singular_verts, 1u);
  EXPECT_TRUE(mentions(report, "vertex 7"));
}

TEST(HexTopology, NamesAVertexWhoseHexesAreNoBall) {
  // Two vertices inside different parts of a mesh made one: its link is two spheres.
  HexMesh mesh = test::box_hex_mesh(2, 2, 2);
  mesh = join(mesh, transformed(mesh, 1, {5, 0, 0}));
  for (auto& hex : mesh.hexes)
    for (VertId& v : hex)
      if (v == VertId(27 + 13)) v = VertId(13);
  const TopologyReport report = check_topology(mesh);
  EXPECT_EQ(report.num_nonmanifold_verts, 0u);  // nothing to see on the boundary
  EXPECT_EQ(report.num_singular_verts, 1u);
  EXPECT_TRUE(mentions(report, "vertex 13"));
}

TEST(HexTopology, NamesHangingVertices) {
  // Eight small hexes on the face x = 1 of a large one.
  const HexMesh large = transformed(test::box_hex_mesh(1, 1, 1), 0.1, {3, 3, 3});
  const HexMesh small = transformed(test::box_hex_mesh(2, 2, 2), 0.05, {3.1, 3, 3});
  const TopologyReport report = check_topology(join(large, small));
  EXPECT_EQ(report.hanging_verts.size(), 5u);  // four edges' middles and the face's
  EXPECT_TRUE(mentions(report, "of hex 0"));
}

TEST(HexTopology, AHangingVertexInsideAFaceAloneIsFound) {
  // On one face a smaller hex, whose vertices all lie strictly inside the face.
  const HexMesh large = test::box_hex_mesh(1, 1, 1);
  const HexMesh small = transformed(test::box_hex_mesh(1, 1, 1), 0.3, {1, 0.35, 0.2});
  EXPECT_EQ(check_topology(join(large, small)).hanging_verts.size(), 4u);
  // A gap of a hundredth is no contact.
  EXPECT_EQ(check_topology(join(large, transformed(small, 1, {0.01, 0, 0}))).hanging_verts.size(),
            0u);
}

TEST(HexTopology, ContactOfBodiesWithRegionsOfTheirOwnIsNotHanging) {
  const HexMesh large = test::box_hex_mesh(1, 1, 1);
  const HexMesh small = transformed(test::box_hex_mesh(1, 1, 1), 0.3, {1, 0.35, 0.2});
  HexMesh both = join(large, small);
  both.region = IdVector<HexId, std::int32_t>(std::vector<std::int32_t>{0, 1});
  const TopologyReport report = check_topology(both);
  EXPECT_TRUE(report.is_valid());
  EXPECT_EQ(report.num_contact_verts, 4u);
  // With a vertex in common they are one body, which does not fit together.
  for (VertId& v : both.hexes[HexId(1)])
    if (v == VertId(8)) v = VertId(0);
  EXPECT_EQ(check_topology(both).num_contact_verts, 0u);
  EXPECT_FALSE(check_topology(both).hanging_verts.empty());
}

TEST(HexTopology, ACrackOfEqualQuadsIsNotHanging) {
  const HexMesh box = test::box_hex_mesh(2, 2, 2);
  EXPECT_EQ(check_topology(join(box, transformed(box, 1, {2, 0, 0}))).hanging_verts.size(), 0u);
}

}  // namespace
}  // namespace hexwright
