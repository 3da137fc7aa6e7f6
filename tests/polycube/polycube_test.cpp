#include "hexwright/polycube/polycube.h"

#include <cmath>

#include <gtest/gtest.h>

#include "hexwright/base/parallel.h"
#include "hexwright/mesh/cut_hexes.h"
#include "hexwright/quality/hex_quality.h"
#include "hexwright/quality/hex_topology.h"
#include "hexwright/quality/surface_distance.h"

#include "helpers.h"
#include "polycube/tet_builders.h"

namespace hexwright {
namespace {

const std::vector<LatticeCoord> kL = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

// Bends the shape and squeezes it towards one end.
Vec3 bend(Vec3 p) {
  const double squeeze = 1 + 1.5 * p.x;
  return {p.x * squeeze, p.y + 0.2 * std::sin(p.x * 2), p.z + 0.1 * p.x * p.y};
}

PolycubeResult mesh_bent(double max_stretch, int max_level) {
  const TetMesh cube = test::tet_cubes(kL, 4);
  PolycubeOptions options;
  options.max_stretch = max_stretch;
  options.max_level = max_level;
  return mesh_polycube(test::mapped(cube, bend), cube, options, {});
}

TEST(Polycube, IdentityMapsToItself) {
  const TetMesh cube = test::tet_cubes(kL, 2);
  PolycubeOptions options;
  options.min_level = options.max_level = 2;
  const auto result = mesh_polycube(cube, cube, options, {});
  EXPECT_NEAR(summarize_quality(result.mesh).total_volume, 3, 1e-9);
  EXPECT_EQ(result.grid.num_cells(), 3u * 64);
  EXPECT_TRUE(check_topology(result.mesh).is_valid());
}

TEST(Polycube, BentShapeIsValidAndOnItsSurface) {
  const auto result = mesh_bent(0.05, 4);
  const auto quality = summarize_quality(result.mesh);
  EXPECT_EQ(quality.num_inverted, 0u);
  EXPECT_GT(quality.min_scaled_jacobian, 0.1);
  EXPECT_TRUE(check_topology(result.mesh).is_valid());
  const auto distance = measure_distance(result.mesh, SurfaceTree(result.surface), {});
  EXPECT_LT(distance.max_two_way(), 0.003);
}

TEST(Polycube, EveryBoundaryQuadHasAPatchAndPolycubeEdgesAreMeshEdges) {
  const auto result = mesh_bent(0.1, 3);
  ASSERT_FALSE(result.mesh.labels.quads.empty());
  std::vector<char> seen(result.report.num_charts, 0);
  for (const auto& quad : result.mesh.labels.quads) {
    ASSERT_TRUE(quad.patch.is_valid());
    seen[quad.patch.index()] = 1;
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 8);  // the faces of an L
  EXPECT_EQ(result.mesh.labels.corners.size(), 12u);
  double length = 0, expected = 0;
  for (const auto& e : result.mesh.labels.edges)
    length += distance(result.mesh.positions[e.verts[0]], result.mesh.positions[e.verts[1]]);
  // The L's 18 edges, measured along fine chains through the same map.
  const auto add = [&](Vec3 a, Vec3 b) {
    for (int i = 0; i < 4; ++i)  // the tets' own edges: the map is linear between them
      for (int k = 0, n = static_cast<int>(std::lround(norm(b - a))); k < n; ++k) {
        const Vec3 d = (b - a) / n;
        expected += distance(bend(a + d * (k + i / 4.0)), bend(a + d * (k + (i + 1) / 4.0)));
      }
  };
  const Vec3 outline[] = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  for (int i = 0; i < 6; ++i) {
    const Vec3 up = {0, 0, 1};
    add(outline[i], outline[(i + 1) % 6]);
    add(outline[i] + up, outline[(i + 1) % 6] + up);
    add(outline[i], outline[i] + up);
  }
  EXPECT_NEAR(length, expected, 0.01 * expected);
}

TEST(Polycube, RefinesWhereTheMapStretches) {
  const auto result = mesh_bent(0.12, 4);
  // x is stretched 2.5 times more at x = 2 than at x = 0: more cells there.
  std::size_t near_start = 0, near_end = 0;
  for (CellId c : result.grid.cells.ids()) {
    const double x = cell_box(result.grid, c).center().x;
    near_start += x < 0.5;
    near_end += x > 1.5;
  }
  EXPECT_GT(near_end, near_start);  // although the L has twice the volume near its start
}

TEST(Polycube, SameResultForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    ThreadLimit limit(threads);
    return mesh_bent(0.1, 3);
  };
  const auto a = run(1), b = run(2);
  EXPECT_EQ(a.mesh.positions, b.mesh.positions);
  EXPECT_EQ(a.mesh.hexes, b.mesh.hexes);
}

TEST(Polycube, RefusesMeshesOfOtherConnectivity) {
  const TetMesh cube = test::tet_cubes(kL, 2);
  TetMesh other = cube;
  std::swap(other.tets[TetId(5)], other.tets[TetId(6)]);
  try {
    mesh_polycube(cube, other, {}, {});
    FAIL() << "tets in another order were accepted";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("tetrahedron 6 "), std::string::npos) << e.what();
  }
  EXPECT_THROW(mesh_polycube(cube, test::tet_cubes(kL, 3), {}, {}), Error);
  EXPECT_THROW(mesh_polycube({}, {}, {}, {}), Error);
}

// A bar twisted hard between coarse tets: all are positive, but cells that reach over several of
// them come out inverted.
TEST(Polycube, UntanglesWhatMappingLeavesInverted) {
  const TetMesh cube = test::tet_cubes({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 1);
  const TetMesh object = test::mapped(cube, [](Vec3 p) {
    const double c = std::cos(0.9 * p.x), s = std::sin(0.9 * p.x), y = p.y - 0.5, z = p.z - 0.5;
    return Vec3{p.x, c * y - s * z, s * y + c * z};
  });
  PolycubeOptions options;
  options.max_stretch = 0.06;
  options.max_surface_error = 0.01;
  const PolycubeResult result = mesh_polycube(object, cube, options, {});
  EXPECT_EQ(result.report.num_nonpositive_polycube, 0u);
  EXPECT_GT(result.report.num_inverted_mapped, 5u);
  EXPECT_TRUE(result.report.folded.empty());
  EXPECT_GT(summarize_quality(result.mesh).min_scaled_jacobian, 0.1);
  EXPECT_GT(summarize_quality(result.mesh).avg_scaled_jacobian, 0.65);
  EXPECT_LE(result.report.max_distance, 0.01);
}

// Both sides as hex meshes, as polycube methods deliver them.
TEST(Polycube, HexMeshesAreSidesToo) {
  const HexMesh box = test::box_hex_mesh(6, 2, 2);
  HexMesh object = box;
  for (Vec3& p : object.positions) p = bend(p * 0.4);
  PolycubeOptions options;
  options.max_stretch = 0.1;
  const PolycubeResult result = mesh_polycube(cut_hexes(object), cut_hexes(box), options, {});
  EXPECT_EQ(result.report.num_tets, kTetsPerHex * box.num_hexes());
  EXPECT_EQ(result.report.num_nonpositive_object, 0u);
  EXPECT_EQ(result.report.num_charts, 6u);
  EXPECT_TRUE(result.verdict.is_valid());
  EXPECT_LT(result.report.max_distance, 0.003);
}

TEST(Polycube, MeetsTheHexesWanted) {
  const TetMesh cube = test::tet_cubes(kL, 4);
  PolycubeOptions options;
  for (std::size_t wanted : {1500, 6000}) {
    options.target_hexes = wanted;
    const auto result = mesh_polycube(test::mapped(cube, bend), cube, options, {});
    const double share = static_cast<double>(result.mesh.num_hexes()) / static_cast<double>(wanted);
    EXPECT_GT(share, 0.75);
    EXPECT_LT(share, 1.05);
    EXPECT_TRUE(result.report.folded.empty());
  }
}

TEST(Polycube, CellBudgetStopsTheRefinement) {
  const TetMesh cube = test::tet_cubes(kL, 2);
  PolycubeOptions options;
  options.min_level = options.max_level = 5;
  options.max_cells = 1000;
  try {
    mesh_polycube(cube, cube, options, {});
    FAIL() << "the budget was ignored";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::OutOfResources);
  }
}

}  // namespace
}  // namespace hexwright
