// Layers beside the other wishes of a run, and walls that get none.
#include <gtest/gtest.h>

#include "hexwright/base/parallel.h"
#include "hexwright/pipeline/mesh_surface.h"

#include "layer_helpers.h"
#include "layers/sheet.h"

namespace hexwright {
namespace {

using namespace test;

MeshResult run(const MeshOptions& options, int threads) {
  const ThreadLimit limit(threads);
  return mesh_surface(unit_sphere_surface(4), options, {});
}

/// Sizes, a domain, both sides and layers together.
TEST(LayersInAMesh, DoNotDependOnTheNumberOfThreadsWithSizesAndBothSides) {
  MeshOptions options;
  options.fit.carve.side = Side::Both;
  options.sizes.size = parse_length("0.3");
  options.sizes.max_size = parse_length("0.8");
  options.sizes.growth = 1.5;
  options.sizes.margin = parse_margin("0.6,0.8,0.7");
  options.sizes.rules = {parse_size_rule("ball:1,0,0,0.3=0.15"),
                         parse_size_rule("region:inside=0.3")};
  options.layers.specs = {parse_layer_spec("*=first:0.05h,growth:1.2,count:3")};
  const MeshResult one = run(options, 1);
  EXPECT_EQ(one.verdict.quality.num_inverted, 0u);
  EXPECT_GE(one.layers.coverage(), 0.99);
  EXPECT_TRUE(std::ranges::count(one.layer.raw(), 3) > 0);
  for (int threads : {2, 3}) {
    const MeshResult other = run(options, threads);
    EXPECT_EQ(one.mesh.positions, other.mesh.positions) << threads;
    EXPECT_EQ(one.mesh.hexes, other.mesh.hexes) << threads;
    EXPECT_EQ(one.mesh.region, other.mesh.region) << threads;
    EXPECT_EQ(one.mesh.labels, other.mesh.labels) << threads;
    EXPECT_EQ(one.layer, other.layer) << threads;
  }
}

/// Layers first, then mid-nodes: those of the wall on the surface, as far as thin hexes allow.
TEST(LayersInAMesh, OfSecondOrderAreProven) {
  MeshOptions options;
  options.order = 2;
  options.sizing.min_level = 3;
  options.layers.specs = {parse_layer_spec("*=first:0.1h,growth:1.2,count:3")};
  const MeshResult r = mesh_surface(unit_sphere_surface(5), options, {});
  EXPECT_TRUE(r.failures.empty());
  ASSERT_TRUE(r.mesh.mid_nodes && r.curving && r.verdict.second_order);
  EXPECT_EQ(r.mesh.mid_nodes->hex_to_edge.size(), r.mesh.num_hexes());
  EXPECT_EQ(r.verdict.quality.num_inverted, 0u);
  EXPECT_GE(r.layers.coverage(), 0.99);
  EXPECT_GT(r.curving->num_curved, 0u);
}

TEST(LayersInAMesh, WithBothSidesAreasAreThoseOfBothWalls) {
  MeshOptions options;
  options.sizing.min_level = 4;
  options.fit.carve.side = Side::Both;
  options.layers.specs = {parse_layer_spec("*=first:0.01,growth:1.2,count:2")};
  const MeshResult r = mesh_surface(unit_sphere_surface(4), options, {});
  double area = 0;
  for (const PatchLayers& row : r.layers.patches) area += row.area;
  EXPECT_NEAR(area, 2 * 4 * 3.14159265, 0.1);
  EXPECT_GE(r.layers.coverage(), 0.99);
  EXPECT_LE(r.layers.coverage(), 1 + 1e-12);
}

/// Every patch of a wall that is left out says why, with the place.
TEST(LayersInAMesh, AllPatchesOfAWallThatIsLeftOutSaySo) {
  const HexMesh mesh = box_whose_floor_goes_on();
  const LayersResult result =
      add_layers(mesh, box_target(4, 4, 4), layers_of({"[xz]m..=first:0.1,growth:1,count:4"}), {});
  ASSERT_EQ(result.report.patches.size(), 4u);
  for (const PatchLayers& row : result.report.patches) {
    EXPECT_NE(row.note.find("'rest' at ("), std::string::npos) << row.patch << ": " << row.note;
    EXPECT_EQ(row.covered, 0) << row.patch;
    EXPECT_NEAR(row.area, row.patch == "zmin" ? 8 : 16, 1e-9);
  }
}

/// What is done with walls whose layers turn out inverted.
TEST(LayersInAMesh, WallsWithABlockedVertexGetNoSheet) {
  const HexMesh mesh = labelled_box(3, 3, 6);
  const LayersOptions options = layers_of({"z*=first:0.1,growth:1,count:2"});
  LayersReport report;
  const auto patches = layers::find_wall_patches(mesh, {}, options, report);
  VertId corner;
  for (VertId v : mesh.positions.ids())
    if (mesh.positions[v] == Vec3{1, 1, 0}) corner = v;
  const layers::SheetMesh sheet = layers::insert_sheets(mesh, {}, patches, options, {corner});
  EXPECT_EQ(sheet.hexes.size(), 9u);  // of zmax
  ASSERT_EQ(sheet.left_out.size(), 1u);
  EXPECT_EQ(sheet.left_out[0].patches, std::vector<PatchId>{PatchId(4)});
  EXPECT_NE(sheet.left_out[0].why.find("(1, 1, 0)"), std::string::npos) << sheet.left_out[0].why;
  EXPECT_NEAR(sheet.wall_area[PatchId(4)], 9, 1e-12);
}

}  // namespace
}  // namespace hexwright
