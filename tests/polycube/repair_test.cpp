// Repair of maps that are folded: squeezed charts, chords between vertices of one face, flat tets.
#include <gtest/gtest.h>

#include "hexwright/polycube/polycube.h"
#include "hexwright/quality/hex_quality.h"

#include "polycube/even_lattice.h"
#include "polycube/map/repair_map.h"
#include "polycube/tet_builders.h"
#include "polycube/tets/tet_boundary.h"
#include "polycube/tets/tet_locator.h"
#include "polycube/tets/unfold.h"

namespace hexwright::polycube {
namespace {

std::size_t count_nonpositive(const TetMesh& mesh) {
  std::size_t count = 0;
  for (TetId t : mesh.tets.ids()) count += !(tet_det(tet_corners(mesh, t)) > 0);
  return count;
}

double total_volume(const TetMesh& mesh) {
  double volume = 0;
  for (TetId t : mesh.tets.ids()) volume += tet_det(tet_corners(mesh, t)) / 6;
  return volume;
}

// Inner vertices of a cube thrown about, so that many tets fold.
TetMesh scrambled(const TetMesh& cube, double amount) {
  TetMesh mesh = cube;
  std::uint32_t seed = 11;
  const auto random = [&] { return (seed = seed * 1664525u + 1013904223u) / 4294967296.0 - 0.5; };
  for (Vec3& p : mesh.positions) {
    const auto is_inner = [](double x) { return x > 1e-9 && x < 1 - 1e-9; };
    if (is_inner(p.x) && is_inner(p.y) && is_inner(p.z))
      p += Vec3{random(), random(), random()} * amount;
  }
  return mesh;
}

TEST(Unfold, MakesAScrambledCubePositiveAndKeepsFixedVertices) {
  const TetMesh cube = test::tet_cubes({{0, 0, 0}}, 4);
  TetMesh image = scrambled(cube, 0.8);
  ASSERT_GT(count_nonpositive(image), 20u);
  IdVector<VertId, std::uint8_t> free_axes(cube.num_verts(), 7);
  for (const auto& f : boundary_facets(cube))
    for (VertId v : f) free_axes[v] = 0;
  EXPECT_EQ(unfold(cube, free_axes, image, {}), 0u);
  EXPECT_EQ(count_nonpositive(image), 0u);
  for (VertId v : cube.positions.ids()) {
    if (!free_axes[v]) {
      EXPECT_EQ(image.positions[v], cube.positions[v]);
    }
  }
}

TEST(RepairMap, LeavesAGoodMapAlone) {
  TetMesh object = test::tet_cubes({{0, 0, 0}}, 3);
  Lattice lattice = fit_lattice(object, 0);
  const TetMesh before = lattice.tets;
  const RepairReport report = repair_map(object, lattice, {});
  EXPECT_EQ(report.num_split_edges, 0u);
  EXPECT_EQ(lattice.tets.positions, before.positions);
  EXPECT_EQ(lattice.tets.tets, before.tets);
}

TEST(RepairMap, UnfoldsAndKeepsTheObject) {
  TetMesh object = test::tet_cubes({{0, 0, 0}, {1, 0, 0}}, 3);
  Lattice lattice = fit_lattice(object, 0);
  lattice.tets = scrambled(lattice.tets, 1.5);
  ASSERT_GT(count_nonpositive(lattice.tets), 0u);
  const auto facets = boundary_facets(object);
  const std::size_t num_before = object.num_tets();

  const RepairReport report = repair_map(object, lattice, {});
  EXPECT_EQ(report.num_nonpositive, 0u);
  EXPECT_EQ(count_nonpositive(lattice.tets), 0u);
  EXPECT_EQ(object.tets, lattice.tets.tets);
  EXPECT_NEAR(total_volume(object), 2, 1e-12);
  EXPECT_EQ(count_nonpositive(object), 0u);
  EXPECT_EQ(report.to_input.size(), object.num_tets());
  for (TetId t : report.to_input) EXPECT_LT(t.index(), num_before);
  // Boundary facets are not cut, and stay in their planes.
  const auto after = boundary_facets(object);
  EXPECT_EQ(after.size(), facets.size());
  for (TriId f : lattice.facets.ids())
    for (VertId v : lattice.facets[f]) {
      const Chart& chart = lattice.charts[static_cast<std::size_t>(lattice.facet_to_chart[f])];
      EXPECT_EQ(lattice.tets.positions[v][chart.axis], chart.plane);
    }
}

// A staircase whose polycube was deformed until its step vanished: the step's tread lies folded in
// the plane of the risers.
Vec3 close_step(Vec3 p) {
  return p.z > 1 ? p : Vec3{p.x > 1 ? 1 + 1e-4 * (p.x - 1) : p.x, p.y, p.z};
}

TEST(RepairMap, GivesASqueezedFaceToItsNeighbour) {
  const TetMesh stair = test::tet_cubes({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, 3);
  const TetMesh closed = test::mapped(stair, close_step);
  const Lattice open = fit_lattice(stair, 0), squeezed = fit_lattice(closed, 1);
  EXPECT_EQ(open.num_merged_charts, 0u);
  EXPECT_EQ(open.charts.size(), 8u);
  EXPECT_GT(squeezed.num_merged_charts, 0u);
  EXPECT_EQ(squeezed.charts.size(), 6u);
  EXPECT_EQ(squeezed.roots.size(), 2u);

  PolycubeOptions options;
  options.spacing = 1;
  options.max_stretch = 0.2;
  options.max_surface_error = 0.02;
  options.max_level = 5;
  const PolycubeResult result = mesh_polycube(stair, closed, options, {});
  EXPECT_GT(result.report.num_nonpositive_polycube, 0u);
  EXPECT_EQ(result.report.num_nonpositive_left, 0u);
  EXPECT_EQ(summarize_quality(result.mesh).num_inverted, 0u);
  EXPECT_TRUE(result.report.folded.empty());
  EXPECT_NEAR(summarize_quality(result.mesh).total_volume, 3, 0.05);
  EXPECT_FALSE(result.report.warnings.empty());
}

}  // namespace
}  // namespace hexwright::polycube
