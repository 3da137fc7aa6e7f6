#include <gtest/gtest.h>

#include "hexwright/layers/layers.h"

#include "layer_helpers.h"

namespace hexwright {
namespace {

using namespace test;

double reduced_by(const PatchLayers& row, LayerLimit limit) {
  return row.reduced[static_cast<std::size_t>(limit)];
}

TEST(WallLimits, FacingWallsShareTheGap) {
  const LayersResult result = add_layers(labelled_box(6, 6, 2), box_target(6, 6, 2),
                                         layers_of({"z*=first:0.5,growth:1,count:4"}), {});
  for (const PatchLayers& row : result.report.patches) {
    EXPECT_NEAR(reduced_by(row, LayerLimit::Gap), 1, 1e-9);
    EXPECT_NEAR(row.mean_thickness, 0.4, 0.02);  // 0.8 of 2, where the gap is 2
  }
  EXPECT_GT(summarize_quality(result.mesh).min_scaled_jacobian, 0.9);
}

TEST(WallLimits, EdgesOfTheWallLimitTheHeight) {
  const LayersResult result = add_layers(labelled_box(12, 12, 12), box_target(12, 12, 12),
                                         layers_of({"zmin=first:2,growth:1,count:4"}), {});
  ASSERT_EQ(result.report.patches.size(), 1u);
  const PatchLayers& row = result.report.patches[0];
  EXPECT_NEAR(reduced_by(row, LayerLimit::Size), 1, 1e-9);
  EXPECT_NEAR(row.mean_thickness, 3.0 / 8, 0.02);
  EXPECT_NEAR(row.covered, 0, 1e-9);
}

TEST(WallLimits, WishesInEdgesFollowTheEdges) {
  HexMesh mesh = labelled_box(6, 6, 6);
  for (Vec3& p : mesh.positions) p = p * 0.5;
  const Target target = wrap_target(box_surface({0, 0, 0}, {3, 3, 3}));
  const LayersResult result =
      add_layers(mesh, target, layers_of({"zmin=first:0.1h,growth:1,count:4"}), {});
  const auto heights = layer_heights(result.mesh, result.layer, [](const Vec3& p) { return p.z; });
  EXPECT_NEAR(median(heights.at(1)), 0.05, 1e-3);
}

/// A patch that goes on flat leaves no room for the end of a sheet.
TEST(WallLimits, WallsThatGoOnFlatAreLeftOut) {
  const HexMesh mesh = box_whose_floor_goes_on();
  const LayersResult result =
      add_layers(mesh, box_target(4, 4, 4), layers_of({"zmin=first:0.1,growth:1,count:4"}), {});
  EXPECT_EQ(result.mesh.num_hexes(), 64u);
  ASSERT_EQ(result.report.patches.size(), 1u);
  EXPECT_NE(result.report.patches[0].note.find("'rest'"), std::string::npos)
      << result.report.patches[0].note;
  EXPECT_DOUBLE_EQ(result.report.patches[0].covered, 0);
}

/// Four cubes around a vertex, each beside the next but not in one plane: two of the walls there
/// face each other's back.
TEST(WallLimits, WallsThatNoDirectionSeesAreLeftOut) {
  const HexMesh box = box_hex_mesh(2, 2, 2);
  HexMesh mesh;
  mesh.positions = box.positions;
  for (HexId h : box.hexes.ids()) {
    Vec3 center;
    for (VertId v : box.hexes[h]) center += box.positions[v] / 8;
    const std::array<bool, 3> is_high = {center.x > 1, center.y > 1, center.z > 1};
    if (is_high[0] >= is_high[1] && is_high[1] >= is_high[2]) mesh.hexes.push_back(box.hexes[h]);
  }
  ASSERT_EQ(mesh.num_hexes(), 4u);
  mesh.labels.patch_names.push_back("wall");
  for (const HexFace& face : compute_hex_neighbors(mesh).boundary)
    mesh.labels.quads.push_back({face_verts(mesh, face), PatchId(0)});
  const LayersResult result =
      add_layers(mesh, box_target(2, 2, 2), layers_of({"*=first:0.02,growth:1,count:2"}), {});
  EXPECT_EQ(result.mesh.num_hexes(), 4u);
  ASSERT_EQ(result.report.patches.size(), 1u);
  const std::string& note = result.report.patches[0].note;
  EXPECT_NE(note.find("refine there"), std::string::npos) << note;
}

}  // namespace
}  // namespace hexwright
