// Measures, shapes and place names of sets.
#include "hexwright/io/set_summary.h"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/sample_meshes.h"

namespace hexwright {
namespace {

/// A quarter of a ring, inner radius 1, outer 2, of height 3; patches are numbered by local face.
HexMesh quarter_ring() {
  HexMesh mesh = test::box_hex_mesh(2, 12, 3);
  for (HexFace face : compute_hex_neighbors(mesh).boundary)
    mesh.labels.quads.push_back({face_verts(mesh, face), PatchId(face.lf)});
  for (Vec3& p : mesh.positions) {
    const double r = 1 + p.x / 2, angle = p.y / 12 * std::numbers::pi / 2;
    p = {r * std::cos(angle), r * std::sin(angle), p.z};
  }
  return mesh;
}

TEST(SetSummary, TellsVolumeAreaAndShape) {
  const HexMesh mesh = quarter_ring();
  const auto sets = summarize_sets(mesh, make_set_table(mesh));
  ASSERT_EQ(sets.size(), 7u);
  EXPECT_NEAR(sets[0].measure, 3 * 0.75 * std::numbers::pi, 0.03);
  const SetSummary &inner = sets[1], &outer = sets[2], &low = sets[3], &bottom = sets[5];
  EXPECT_EQ(inner.shape, SetShape::Cylinder);
  EXPECT_NEAR(inner.radius, 1, 1e-9);
  EXPECT_NEAR(outer.radius, 2, 1e-9);
  EXPECT_NEAR(inner.measure, 3 * std::numbers::pi / 2, 0.01);
  EXPECT_NEAR(distance(outer.direction, {0, 0, 1}), 0, 1e-9);
  EXPECT_EQ(low.shape, SetShape::Plane);
  EXPECT_NEAR(distance(low.direction, {0, -1, 0}), 0, 1e-9);
  EXPECT_NEAR(distance(low.centroid, {1.5, 0, 1.5}), 0, 1e-9);
  EXPECT_NEAR(distance(bottom.direction, {0, 0, -1}), 0, 1e-9);
}

TEST(SetSummary, VolumesOfRegionsAddUp) {
  const HexMesh mesh = test::named_box();
  double volume = 0, area = 0;
  for (const SetSummary& set : summarize_sets(mesh, make_set_table(mesh))) {
    if (set.kind == SetKind::Region) volume += set.measure;
    if (set.kind == SetKind::Patch) area += set.measure;
    if (set.kind == SetKind::Curve) {
      EXPECT_NEAR(set.measure, 1, 1e-9);
    }
  }
  EXPECT_NEAR(volume, 12, 1e-9);
  EXPECT_NEAR(area, 32, 1e-9);
}

TEST(SetSummary, UnnamedPatchesAreCalledByTheirPlaceWhereItIsPlain) {
  HexMesh mesh = quarter_ring();
  SetTable table = make_set_table(mesh);
  name_by_place(mesh, table);
  const auto name = [&](std::int32_t patch) { return SetTable::at(table.patches, patch).name; };
  EXPECT_EQ(name(0), "patch_cyl_r1");
  EXPECT_EQ(name(1), "patch_cyl_r2");
  EXPECT_EQ(name(2), "patch_ymin");
  EXPECT_EQ(name(3), "patch_xmin");
  EXPECT_EQ(name(4), "patch_zmin");
  EXPECT_EQ(name(5), "patch_zmax");
  // Two patches on one side: neither is the side.
  for (LabeledQuad& quad : mesh.labels.quads)
    if (quad.patch == PatchId(5) && mesh.positions[quad.verts[0]].x > 0.7) quad.patch = PatchId(6);
  mesh.labels.patch_names = {"", "patch_ymin", "", "", "", "", ""};
  table = make_set_table(mesh);
  name_by_place(mesh, table);
  EXPECT_EQ(name(5), "PATCH_5");
  EXPECT_EQ(name(6), "PATCH_6");
  EXPECT_EQ(name(2), "PATCH_2") << "the name is a user's";
}

// In letters that no format has to change, and without the point that would make it a group's part.
TEST(SetSummary, NamesByPlaceAreWords) {
  for (const double scale : {1.25, 1e-6, 1e6}) {
    HexMesh mesh = quarter_ring();
    for (Vec3& p : mesh.positions) p = p * scale;
    SetTable table = make_set_table(mesh);
    name_by_place(mesh, table);
    for (const NamedSet& set : table.patches)
      EXPECT_TRUE(std::all_of(set.name.begin(), set.name.end(), is_word_letter)) << set.name;
    if (scale == 1.25) {
      EXPECT_EQ(table.patches[1].name, "patch_cyl_r2_5");
    }
    mesh.labels.patch_names.resize(6);
    for (const NamedSet& set : table.patches)
      mesh.labels.patch_names[PatchId(set.number)] = set.name;
    EXPECT_TRUE(make_set_table(mesh).patch_groups.empty());
  }
}

TEST(SetSummary, ASideThatIsNotQuiteFlatIsAPlane) {
  HexMesh mesh = quarter_ring();
  for (Vec3& p : mesh.positions)
    if (p.z == 3 && p.x > 1 && p.y > 1) p.z += 1e-3;
  SetTable table = make_set_table(mesh);
  name_by_place(mesh, table);
  EXPECT_EQ(table.patches[5].name, "patch_zmax");
  for (Vec3& p : mesh.positions)
    if (p.z > 3) p.z += 0.1;
  table = make_set_table(mesh);
  name_by_place(mesh, table);
  EXPECT_EQ(table.patches[5].name, "PATCH_5");
}

TEST(SetSummary, IsWrittenAsJsonAndText) {
  const HexMesh mesh = quarter_ring();
  const auto sets = summarize_sets(mesh, make_set_table(mesh));
  const auto json = nlohmann::json::parse(sets_to_json(sets));
  ASSERT_EQ(json.size(), 7u);
  EXPECT_EQ(json[0]["kind"], "region");
  EXPECT_EQ(json[1]["name"], "PATCH_0");
  EXPECT_NEAR(json[1]["radius"].get<double>(), 1, 1e-9);
  EXPECT_TRUE(json[3].contains("normal"));
  EXPECT_NE(sets_to_text(sets).find("normal (0 -1 0)"), std::string::npos) << sets_to_text(sets);
}

}  // namespace
}  // namespace hexwright
