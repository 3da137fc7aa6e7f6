#include "hexwright/fit/carve.h"

#include <gtest/gtest.h>

#include "hexwright/quality/hex_quality.h"
#include "hexwright/quality/hex_topology.h"

#include "fit/carve/carve_classify.h"
#include "fit/carve/carve_repair.h"
#include "fit/carve/set_check.h"
#include "fit/carve/visible_normal.h"
#include "fit_helpers.h"

namespace hexwright {
namespace {

using namespace fitting;

TEST(VisibleNormal, FindsTheBestDirectionOfRandomCones) {
  std::mt19937 rng(17);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 axis = normalized(Vec3{normal(rng), normal(rng), normal(rng)});
    std::vector<Vec3> normals;
    for (int i = 0; i < 5; ++i)
      normals.push_back(normalized(axis + 0.5 * Vec3{normal(rng), normal(rng), normal(rng)}));
    const VisibleDirection got = find_visible_direction(normals, 1);
    // Brute force: the optimum touches two or three of the normals equally; random search suffices.
    double best = -1;
    for (int k = 0; k < 4000; ++k) {
      const Vec3 d = normalized(got.direction + 0.3 * Vec3{normal(rng), normal(rng), normal(rng)});
      double least = 2;
      for (const Vec3& n : normals) least = std::min(least, dot(n, d));
      best = std::max(best, least);
    }
    double least = 2;
    for (const Vec3& n : normals) least = std::min(least, dot(n, got.direction));
    EXPECT_NEAR(got.cosine, least, 1e-12);
    if (best > 0.1) {
      EXPECT_GE(got.cosine, best - 0.04);  // 40 steps come that close
    }
  }
}

// What is carved from random blobs is a manifold whose boundary is visible at every vertex.
TEST(Carve, RepairMakesRandomBlobsManifoldAndVisible) {
  std::mt19937 rng(23);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int trial = 0; trial < 12; ++trial) {
    const HexMesh mesh = test::box_hex_mesh(9, 9, 9);
    const VertToHex vert_to_hex(mesh);
    const HexNeighbors neighbors = compute_hex_neighbors(mesh);
    HexFilling filling;
    filling.fraction.resize(mesh.num_hexes());
    filling.edge.assign(mesh.num_hexes(), 1);
    std::vector<char> in_set(mesh.num_hexes());
    for (HexId h : mesh.hexes.ids()) {
      filling.fraction[h] = uniform(rng);
      in_set[h.index()] = filling.fraction[h] > 0.5f;
    }
    const RepairResult repair = repair_set(mesh, vert_to_hex, neighbors, filling, 0.1, in_set);
    EXPECT_GT(repair.num_flips, 0u);
    EXPECT_EQ(repair.num_bad_verts, 0u);
    const HexMesh part = extract_hexes(mesh, in_set);
    if (part.num_hexes() == 0) continue;
    const TopologyReport topology = check_topology(part);
    EXPECT_EQ(topology.num_nonmanifold_edges, 0u);
    EXPECT_EQ(topology.num_nonmanifold_verts, 0u);
    const VertToHex part_verts(part);
    const HexNeighbors part_neighbors = compute_hex_neighbors(part);
    SetCheck check(part, part_verts, part_neighbors, true);
    const std::vector<char> all(part.num_hexes(), 1);
    for (VertId v : part.positions.ids()) EXPECT_GE(check.direction(v, all).cosine, 0.099);
  }
}

TEST(Carve, KeepsTheShapesTopology) {
  const SurfaceTree torus(test::torus_surface(1, 0.4, 60, 30));
  const CarveResult result = carve(test::grid_around(torus.box(), 0.13), torus, {}, {});
  EXPECT_EQ(result.num_components, 1u);
  EXPECT_EQ(result.euler_characteristic, 0);
  EXPECT_EQ(result.num_bad_verts, 0u);
  EXPECT_TRUE(result.lost.empty());
}

TEST(Carve, KeepsAboutTheShapesVolume) {
  const SurfaceTree sphere(test::welded(test::unit_sphere_surface(4)));
  const HexMesh grid = test::grid_around(sphere.box(), 0.12);
  const HexMesh part = extract_hexes(grid, carve(grid, sphere, {}, {}).is_kept);
  double volume = 0;
  for (HexId h : part.hexes.ids()) volume += hex_volume(part.corners(h));
  EXPECT_NEAR(volume, 4.18879, 0.05 * 4.18879);
}

// Signs inherited from neighbours (closed surface) and signs computed one by one (the same surface
// with every triangle on its own, and with a few triangles missing) agree.
TEST(Carve, ClosedAndOpenSurfacesGiveTheSameSet) {
  const TriMesh closed = test::welded(test::unit_sphere_surface(4));
  TriMesh open = closed;
  open.tris.raw().resize(open.num_tris() - 3);
  const HexMesh grid = test::grid_around(bounding_box(closed), 0.15);
  const auto expected = carve(grid, SurfaceTree(closed), {}, {}).is_kept;
  EXPECT_EQ(carve(grid, SurfaceTree(test::unit_sphere_surface(4)), {}, {}).is_kept, expected);
  EXPECT_EQ(carve(grid, SurfaceTree(open), {}, {}).is_kept, expected);
}

TEST(Carve, DropsCrumbsAndReportsThinParts) {
  TriMesh surface = test::unit_cube_surface();
  // A plate as thin as a tenth of a hex, well away from the cube.
  const TriMesh cube = surface;
  const int base = static_cast<int>(surface.num_verts());
  for (const Vec3& p : cube.positions) surface.positions.push_back({p.x + 2, p.y, 0.011 * p.z});
  for (const auto& tri : cube.tris)
    surface.tris.push_back({VertId(base + tri[0].value()), VertId(base + tri[1].value()),
                            VertId(base + tri[2].value())});
  const SurfaceTree tree(surface);
  const ExpectedTopology unknown;  // with it, the plate would be kept
  const CarveResult result = carve(test::grid_around(tree.box(), 0.11), tree, unknown, {}, {});
  EXPECT_EQ(result.num_components, 1u);
  ASSERT_FALSE(result.lost.empty());
  for (const Vec3& p : result.lost) EXPECT_GT(p.x, 1.5);
}

TEST(Carve, RejectsAFractionOutOfRange) {
  const SurfaceTree cube(test::unit_cube_surface());
  CarveOptions options;
  options.keep_fraction = 1.5;
  EXPECT_THROW(carve(test::box_hex_mesh(2, 2, 2), cube, options, {}), Error);
}

}  // namespace
}  // namespace hexwright
