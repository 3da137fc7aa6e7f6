// Mid-nodes on surfaces, and elements that stay valid.
#include "hexwright/curving/curve_mesh.h"

#include <cmath>
#include <numbers>

#include "hexwright/mesh/hex_adjacency.h"
#include "hexwright/pipeline/mesh_surface.h"
#include "hexwright/quality/hex_quality.h"

#include "solids.h"

namespace hexwright {
namespace {

MeshResult mesh_to_second_order(const TriMesh& surface) {
  MeshOptions options;
  options.order = 2;
  options.target.placement = Placement::AsGiven;
  return mesh_surface(surface, options, {});
}

/// Of the mid-nodes of quads with a patch, the greatest distance to the surface.
double farthest_mid_node(const HexMesh& mesh, const TriMesh& surface) {
  const SurfaceTree tree(surface);
  const EdgeTable edges(mesh);
  double farthest = 0;
  for (const LabeledQuad& quad : mesh.labels.quads)
    for (std::size_t k = 0; k < 4; ++k) {
      const EdgeId e = edges.find(quad.verts[k], quad.verts[(k + 1) % 4]);
      farthest = std::max(farthest, tree.distance(mesh.mid_nodes->edges[e]));
    }
  return farthest;
}

TEST(CurveMesh, PutsMidNodesOnTheSurface) {
  const TriMesh sphere = test::unit_sphere_surface(5);
  const MeshResult result = mesh_to_second_order(sphere);
  ASSERT_TRUE(result.failures.empty()) << result.failures[0];
  ASSERT_TRUE(result.curving);
  EXPECT_EQ(result.curving->num_unmatched, 0u);
  EXPECT_TRUE(result.curving->held_back.empty());
  EXPECT_GT(result.curving->num_curved, result.curving->num_surface_edges * 9 / 10);
  EXPECT_LT(farthest_mid_node(result.mesh, sphere), 1e-12);
  ASSERT_TRUE(result.verdict.second_order);
  EXPECT_EQ(result.verdict.second_order->num_not_positive, 0u);
  EXPECT_EQ(result.verdict.second_order->num_undecided, 0u);
  // Straight edges lose hundreds of times as much of the volume.
  ASSERT_TRUE(result.verdict.volume_error);
  const double exact = 4 * std::numbers::pi / 3;
  EXPECT_LT(std::abs(*result.verdict.volume_error), 3e-4);
  EXPECT_GT(std::abs(result.verdict.quality.total_volume / exact - 1), 3e-3);
}

TEST(CurveMesh, PutsThoseOfFeatureEdgesOnTheCurve) {
  const double radius = 0.5;
  const TriMesh cylinder = test::cylinder_surface(0, radius, 0, 1, 256);
  const MeshResult result = mesh_to_second_order(cylinder);
  ASSERT_TRUE(result.failures.empty()) << result.failures[0];
  const HexMesh& mesh = result.mesh;
  ASSERT_FALSE(mesh.labels.edges.empty());
  const EdgeTable edges(mesh);
  const double sag = radius * (1 - std::cos(std::numbers::pi / 256));  // of the polygon
  for (const LabeledEdge& edge : mesh.labels.edges) {
    const Vec3 p = mesh.mid_nodes->edges[edges.find(edge.verts[0], edge.verts[1])];
    EXPECT_NEAR(norm(Vec3{p.x, p.y, 0}), radius, 1.01 * sag);
    EXPECT_LT(std::min(std::abs(p.z), std::abs(p.z - 1)), 1e-12);
  }
}

/// Two neighbouring sides of the hex lie on one cylinder: their angle of 160 degrees would become
/// flat.
TEST(CurveMesh, HoldsBackWhatWouldFlattenAnElement) {
  const auto at = [](double radius, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return Vec3{radius * std::cos(angle), radius * std::sin(angle), 0};
  };
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  const std::array<Vec3, 4> ring = {at(0.8, 20), at(1, 0), at(1, 20), at(1, 40)};
  for (std::size_t lv = 0; lv < 8; ++lv)
    mesh.positions[mesh.hexes[HexId(0)][lv]] = ring[lv % 4] + Vec3{0, 0, lv < 4 ? 0 : 0.3};
  for (int lf : {1, 3}) mesh.labels.quads.push_back({face_verts(mesh, {HexId(0), lf}), PatchId(0)});
  const Target target = wrap_target(test::cylinder_surface(0, 1, -1, 1, 1024));
  const SurfaceParts parts{
      {},
      PatchIndex(target.tree, IdVector<TriId, PatchId>(target.surface().num_tris(), PatchId(0)))};
  const CurvingReport report = curve_mesh(mesh, {target.tree, parts}, {});
  EXPECT_EQ(report.num_surface_edges, 7u);
  EXPECT_EQ(report.num_unmatched, 0u);
  ASSERT_FALSE(report.held_back.empty());
  EXPECT_LT(report.held_back.size(), 4u);  // one of two edges at most, above and below
  EXPECT_GT(report.held_back[0].distance, 0.001);
  const SecondOrderQuality quality = summarize_second_order(mesh);
  EXPECT_EQ(quality.num_not_positive + quality.num_undecided, 0u);
  EXPECT_EQ(quality.num_curved, 1u);
  EXPECT_GT(quality.total_volume, hex_volume(mesh.corners(HexId(0))));
}

TEST(CurveMesh, LeavesEdgesWithoutASurfaceStraight) {
  HexMesh mesh = test::box_hex_mesh(2, 1, 1);
  mesh.labels.quads.push_back({face_verts(mesh, {HexId(0), 0}), PatchId(0)});
  const Target target = wrap_target(test::box_surface({50, 50, 50}, {51, 51, 51}));
  const CurvingReport report = curve_mesh(mesh, {target.tree, {}}, {});
  EXPECT_EQ(report.num_unmatched, 4u);
  EXPECT_EQ(report.num_curved, 0u);
  EXPECT_EQ(mesh.mid_nodes->edges.raw(), make_straight_mid_nodes(mesh).edges.raw());
}

}  // namespace
}  // namespace hexwright
