#include "hexwright/geometry/prepare_surface.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "hexwright/geometry/surface_topology.h"
#include "hexwright/io/surface_io.h"

#include "geometry/random_soup.h"
#include "solids.h"

namespace hexwright {
namespace {

using test::reversed;

void append(TriMesh& to, TriMesh from, double scale, const Vec3& shift) {
  for (Vec3& p : from.positions) p = p * scale + shift;
  append(to, from);
}

/// Every triangle with its own three vertices, moved by up to `noise`.
TriMesh soup_of(const TriMesh& mesh, double noise) {
  std::mt19937_64 random(29);
  TriMesh soup;
  for (TriId t : mesh.tris.ids()) {
    std::array<VertId, 3> tri;
    for (std::size_t k = 0; k < 3; ++k)
      tri[k] = soup.positions.push_back(mesh.corners(t)[k] + test::random_point(random, noise));
    soup.tris.push_back(tri);
  }
  return soup;
}

TriMesh cube_in_cube(bool is_inner_reversed) {
  TriMesh both = test::unit_cube_surface();
  const TriMesh inner = test::unit_cube_surface();
  append(both, is_inner_reversed ? reversed(inner) : inner, 0.5, {0.25, 0.25, 0.25});
  return both;
}

void expect_refused(const TriMesh& mesh, const std::string& part_of_message) {
  try {
    prepare_surface(mesh, {});
    ADD_FAILURE() << "accepted: " << part_of_message;
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::BadGeometry);
    EXPECT_NE(std::string(e.what()).find(part_of_message), std::string::npos) << e.what();
  }
}

Vec3 normal_of(const TriMesh& mesh, TriId t) {
  const auto c = mesh.corners(t);
  return cross(c[1] - c[0], c[2] - c[0]);
}

/// The same surface with its vertices renumbered, its triangles reordered and begun elsewhere.
TriMesh shuffled(const TriMesh& mesh, std::mt19937_64& random) {
  std::vector<std::size_t> place(mesh.num_verts());
  std::iota(place.begin(), place.end(), std::size_t{0});
  std::shuffle(place.begin(), place.end(), random);
  TriMesh out;
  out.positions.resize(mesh.num_verts());
  for (VertId v : mesh.positions.ids()) out.positions[VertId(place[v.index()])] = mesh.positions[v];
  for (auto tri : mesh.tris) {
    for (VertId& v : tri) v = VertId(place[v.index()]);
    std::rotate(tri.begin(), tri.begin() + static_cast<std::ptrdiff_t>(random() % 3), tri.end());
    out.tris.push_back(tri);
  }
  std::shuffle(out.tris.raw().begin(), out.tris.raw().end(), random);
  return out;
}

TEST(PrepareSurface, LeavesAGoodSurfaceAlone) {
  const TriMesh cube = test::unit_cube_surface();
  const auto p = prepare_surface(cube, {});
  EXPECT_EQ(p.mesh.num_verts(), cube.num_verts());
  ASSERT_EQ(p.mesh.num_tris(), cube.num_tris());
  for (TriId t : p.mesh.tris.ids())  // the same triangles with the same sides, in another order
    EXPECT_EQ(normal_of(p.mesh, t), normal_of(cube, p.source_tri[t]));
  EXPECT_NEAR(enclosed_volume(p.mesh), 1, 1e-12);
  EXPECT_TRUE(p.diagnosis.is_closed);
  EXPECT_TRUE(p.diagnosis.warnings.empty());
}

// Files that differ in the order of their lines give the same surface to the last bit.
TEST(PrepareSurface, TheOrderOfVerticesAndTrianglesDoesNotMatter) {
  std::mt19937_64 random(77);
  for (const char* name : {"3holes.obj", "cube_minus_sphere.obj", "plate_holes.stl",
                           "spot_low_resolution.obj", "20mm-xyz-cube.stl"}) {
    const TriMesh surface = read_surface(test::bundled(std::string("models/") + name)).mesh;
    const TriMesh expected = prepare_surface(surface, {}).mesh;
    for (int round = 0; round < 2; ++round) {
      const TriMesh mesh = prepare_surface(shuffled(surface, random), {}).mesh;
      EXPECT_EQ(mesh.positions, expected.positions) << name;
      EXPECT_EQ(mesh.tris, expected.tris) << name;
    }
  }
}

TEST(PrepareSurface, WeldsSoupsEvenWhenInexact) {
  for (double noise : {0.0, 1e-12, 1e-9, 1e-7}) {
    const auto p = prepare_surface(soup_of(test::unit_cube_surface(), noise), {});
    EXPECT_TRUE(p.diagnosis.is_closed) << noise;
    EXPECT_EQ(p.mesh.num_verts(), 8u);
    EXPECT_EQ(p.diagnosis.num_welded_verts, 28u);
    EXPECT_NEAR(enclosed_volume(p.mesh), 1, 1e-6);
  }
}

TEST(PrepareSurface, NeverWeldsAcrossAGapOrAThinSheet) {
  TriMesh gap = test::unit_cube_surface();
  append(gap, test::unit_cube_surface(), 1, {1 + 1e-9, 0, 0});
  TriMesh sheet = test::unit_cube_surface();
  for (Vec3& p : sheet.positions) p.z *= 1e-7;
  for (const TriMesh& mesh : {gap, sheet})
    for (const TriMesh& given : {mesh, soup_of(mesh, 0)}) {
      const auto p = prepare_surface(given, {});
      EXPECT_TRUE(p.diagnosis.is_closed);
      EXPECT_EQ(p.mesh.num_verts(), mesh.num_verts());
      EXPECT_EQ(compute_topology(p.mesh).num_components, compute_topology(mesh).num_components);
    }
}

TEST(PrepareSurface, TouchingSolidsAsTheyAreStayApartUnlessTheyComeAsASoup) {
  const PrepareOptions as_is{.parts = Parts::AsIs};
  TriMesh touching = test::unit_cube_surface();
  append(touching, test::unit_cube_surface(), 1, {1, 0, 0});
  EXPECT_EQ(compute_topology(prepare_surface(touching, as_is, {}).mesh).num_components, 2u);
  const auto merged = prepare_surface(soup_of(touching, 0), as_is, {});
  EXPECT_TRUE(merged.diagnosis.is_closed);
  EXPECT_NEAR(enclosed_volume(merged.mesh), 2, 1e-12);
}

TEST(PrepareSurface, DropsRepeatedAndDuplicateTriangles) {
  TriMesh cube = test::unit_cube_surface();
  cube.tris.push_back({VertId(1), VertId(1), VertId(2)});
  cube.tris.push_back(cube.tris[TriId(3)]);
  cube.tris.push_back({cube.tris[TriId(5)][1], cube.tris[TriId(5)][2], cube.tris[TriId(5)][0]});
  const auto p = prepare_surface(cube, {});
  EXPECT_EQ(p.diagnosis.num_degenerate_tris, 1u);
  EXPECT_EQ(p.diagnosis.num_duplicate_tris, 2u);
  EXPECT_EQ(p.mesh.tris, prepare_surface(test::unit_cube_surface(), {}).mesh.tris);
}

TEST(PrepareSurface, FlipsCapsIntoTheirNeighbour) {
  // The side of a cube with a vertex in the middle of an edge, closed by a triangle without area.
  TriMesh cube = test::unit_cube_surface();
  const auto [a, b, c] = cube.tris[TriId(0)];
  const VertId m = cube.positions.push_back((cube.positions[a] + cube.positions[b]) * 0.5);
  cube.tris[TriId(0)] = {a, m, c};
  cube.tris.push_back({m, b, c});
  cube.tris.push_back({a, b, m});
  ASSERT_TRUE(compute_topology(cube).is_closed_manifold());
  const auto p = prepare_surface(cube, {});
  EXPECT_TRUE(p.diagnosis.is_closed);
  EXPECT_EQ(p.diagnosis.num_degenerate_tris, 1u);
  for (TriId t : p.mesh.tris.ids()) {
    const auto x = p.mesh.corners(t);
    EXPECT_GT(norm(cross(x[1] - x[0], x[2] - x[0])), 0.1);
  }
  EXPECT_NEAR(enclosed_volume(p.mesh), 1, 1e-12);
}

TEST(PrepareSurface, TurnsAnInsideOutSurface) {
  const auto p = prepare_surface(reversed(test::unit_cube_surface()), {});
  EXPECT_TRUE(p.diagnosis.is_flipped_whole);
  EXPECT_NEAR(enclosed_volume(p.mesh), 1, 1e-12);
}

TEST(PrepareSurface, RepairsRandomOrientations) {
  const TriMesh good = prepare_surface(test::unit_sphere_surface(3), {}).mesh;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::mt19937_64 random(seed);
    TriMesh bad = good;
    std::size_t num_bad = 0;
    for (auto& t : bad.tris)
      if (random() % 20 < seed) {
        std::swap(t[1], t[2]);
        ++num_bad;
      }
    const auto p = prepare_surface(bad, {});
    EXPECT_TRUE(p.diagnosis.is_closed);
    EXPECT_NEAR(enclosed_volume(p.mesh), enclosed_volume(good), 1e-9);
    EXPECT_EQ(p.diagnosis.num_flipped_tris, num_bad);
  }
}

TEST(PrepareSurface, CavitiesStayCavitiesWhateverTheWholeOrientation) {
  const double expected = 1 - 0.125;
  EXPECT_NEAR(enclosed_volume(prepare_surface(cube_in_cube(true), {}).mesh), expected, 1e-12);
  EXPECT_NEAR(enclosed_volume(prepare_surface(reversed(cube_in_cube(true)), {}).mesh), expected,
              1e-12);
}

TEST(PrepareSurface, ShellsInsideASolidAreIgnoredWithAWarning) {
  const auto p = prepare_surface(cube_in_cube(false), {});
  EXPECT_NEAR(enclosed_volume(p.mesh), 1, 1e-12);
  EXPECT_EQ(p.diagnosis.num_hidden_parts, 1u);
  ASSERT_EQ(p.diagnosis.warnings.size(), 1u);
  EXPECT_NE(p.diagnosis.warnings[0].find("cavity"), std::string::npos);
}

TEST(PrepareSurface, SolidInsideACavityIsKept) {
  TriMesh three = cube_in_cube(true);
  append(three, test::unit_cube_surface(), 0.25, {0.375, 0.375, 0.375});
  const auto p = prepare_surface(three, {});
  EXPECT_NEAR(enclosed_volume(p.mesh), 1 - 0.125 + 0.015625, 1e-12);
  EXPECT_TRUE(p.diagnosis.warnings.empty());
}

// Nested shells of any orientation: whichever are dropped, the region of winding number above one
// half stays what it was. Three outward shells are one ball; alternating ones a shell with a core.
TEST(PrepareSurface, NestedShellsKeepTheRegionInside) {
  for (unsigned signs = 0; signs < 8; ++signs) {
    TriMesh nested = test::unit_cube_surface();
    for (int depth = 1; depth <= 3; ++depth) {
      const double size = 1 - 0.25 * depth, low = (1 - size) / 2;
      const TriMesh cube = test::unit_cube_surface();
      append(nested, signs >> (depth - 1) & 1 ? reversed(cube) : cube, size, {low, low, low});
    }
    const TriMesh prepared = prepare_surface(nested, {}).mesh;
    for (double z : {0.05, 0.2, 0.3, 0.45}) {  // one point between each two shells
      const Vec3 p = {0.5, 0.5, z};
      EXPECT_EQ(test::brute_winding(prepared, p) > 0.5, test::brute_winding(nested, p) > 0.5)
          << "orientations " << signs << ", z = " << z;
    }
  }
  TriMesh ball = cube_in_cube(false);
  append(ball, test::unit_cube_surface(), 0.25, {0.375, 0.375, 0.375});
  const auto p = prepare_surface(ball, {});
  EXPECT_EQ(p.mesh.num_tris(), 12u);
  EXPECT_EQ(p.diagnosis.num_hidden_parts, 2u);
}

TEST(PrepareSurface, AWallAcrossTheInsideIsIgnored) {
  TriMesh cube = test::unit_cube_surface();
  cube.tris.push_back({VertId(0), VertId(1), VertId(7)});
  cube.tris.push_back({VertId(0), VertId(7), VertId(6)});
  const auto p = prepare_surface(cube, {});
  EXPECT_TRUE(p.diagnosis.is_closed);
  EXPECT_EQ(p.mesh.tris, prepare_surface(test::unit_cube_surface(), {}).mesh.tris);
}

TEST(PrepareSurface, OverlappingSolidsAsTheyAreAreKeptWhole) {
  TriMesh two = test::unit_cube_surface();
  append(two, test::unit_cube_surface(), 1, {0.5, 0.4, 0.3});
  EXPECT_EQ(prepare_surface(two, {.parts = Parts::AsIs}, {}).mesh.num_tris(), 24u);
}

TEST(PrepareSurface, OnePieceInsideOutAmongSeveralIsTurned) {
  TriMesh pieces = test::unit_cube_surface();
  append(pieces, reversed(test::unit_cube_surface()), 0.5, {3, 0, 0});
  EXPECT_NEAR(enclosed_volume(prepare_surface(pieces, {}).mesh), 1.125, 1e-12);
}

TEST(PrepareSurface, OpenSurfacesWithAnInsideAreAcceptedAndTurnedOutwards) {
  TriMesh open = test::unit_cube_surface();
  open.tris.resize(10);
  for (const TriMesh& mesh : {open, reversed(open)}) {
    const auto p = prepare_surface(mesh, {});
    EXPECT_EQ(p.diagnosis.num_boundary_edges, 4u);
    EXPECT_EQ(p.diagnosis.num_filled_holes, 1u);
    EXPECT_FALSE(p.diagnosis.warnings.empty());
    EXPECT_TRUE(p.diagnosis.is_closed);
    EXPECT_NEAR(enclosed_volume(p.mesh), 1, 1e-12);
    EXPECT_EQ(std::count(p.source_tri.begin(), p.source_tri.end(), TriId()), 2);
  }
}

/// A tube along z over a regular polygon, without its two ends.
TriMesh open_tube(int n) {
  TriMesh tube;
  for (int z = 0; z < 2; ++z)
    for (int i = 0; i < n; ++i) {
      const double a = 2 * std::numbers::pi * i / n;
      tube.positions.push_back({std::cos(a), std::sin(a), 3.0 * z});
    }
  for (int i = 0; i < n; ++i) {
    const VertId a(i), b((i + 1) % n), c(n + i), d(n + (i + 1) % n);
    tube.tris.push_back({a, b, d});
    tube.tris.push_back({a, d, c});
  }
  return tube;
}

// Borders beyond the length that is triangulated at once, too.
TEST(PrepareSurface, HolesOfAnyLengthAreClosedFlat) {
  for (int n : {3, 6, 50, 200, 201, 777}) {
    const auto p = prepare_surface(open_tube(n), {});
    EXPECT_TRUE(p.diagnosis.is_closed) << n;
    EXPECT_EQ(p.diagnosis.num_filled_holes, 2u);
    EXPECT_EQ(p.mesh.num_tris(), std::size_t(2 * n + 2 * (n - 2)));
    const double area = 0.5 * n * std::sin(2 * std::numbers::pi / n);
    EXPECT_NEAR(enclosed_volume(p.mesh), 3 * area, 1e-9) << n;
    EXPECT_EQ(compute_topology(p.mesh).euler_characteristic, 2);
  }
}

// Removes random triangles of a closed sphere: every set of holes closes again, each loop with two
// triangles less than its edges (lone triangles between holes cancel with their patch).
TEST(PrepareSurface, RandomHolesAreClosedAgain) {
  const TriMesh sphere = prepare_surface(test::unit_sphere_surface(3), {}).mesh;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 random(seed);
    TriMesh open;
    open.positions = sphere.positions;
    for (const auto& t : sphere.tris)
      if (random() % 10 != 0) open.tris.push_back(t);
    const auto p = prepare_surface(open, {.parts = Parts::AsIs}, {});
    EXPECT_TRUE(p.diagnosis.is_closed) << "seed " << seed;
    EXPECT_EQ(p.mesh.num_tris() + p.diagnosis.num_duplicate_tris,
              open.num_tris() + p.diagnosis.num_boundary_edges - 2 * p.diagnosis.num_filled_holes);
    EXPECT_NEAR(enclosed_volume(p.mesh), enclosed_volume(sphere), 0.02) << "seed " << seed;
  }
}

TEST(PrepareSurface, AFinThatHangsOnTheSurfaceIsNoHole) {
  TriMesh cube = test::unit_cube_surface();
  const VertId tip = cube.positions.push_back({2, 0, 0.5});  // outside, on the edge 1-5
  cube.tris.push_back({VertId(1), VertId(5), tip});
  const auto p = prepare_surface(cube, {});
  EXPECT_EQ(p.diagnosis.num_boundary_edges, 2u);
  EXPECT_EQ(p.diagnosis.num_filled_holes, 0u);
  EXPECT_NEAR(enclosed_volume(p.mesh), 1, 0.5);
}

TEST(PrepareSurface, WorksAtAnyScaleAndPosition) {
  const TriMesh cube = test::unit_cube_surface();
  for (double scale : {1e-310, 1e-200, 1e-20, 1e30, 1e200, 1e307}) {
    TriMesh scaled;
    append(scaled, cube, scale, {});
    const auto p = prepare_surface(soup_of(scaled, 0), {});
    EXPECT_TRUE(p.diagnosis.is_closed) << scale;
    EXPECT_EQ(p.mesh.num_verts(), 8u);
  }
  TriMesh far;
  append(far, cube, 1, {1e9, -1e9, 1e9});
  EXPECT_TRUE(prepare_surface(soup_of(far, 0), {}).diagnosis.is_closed);
}

TEST(PrepareSurface, StrayVerticesDoNotMatter) {
  TriMesh cube = test::unit_cube_surface();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  cube.positions.push_back({1e300, nan, 0});
  const auto p = prepare_surface(cube, {});
  EXPECT_EQ(p.mesh.num_verts(), 8u);
}

TEST(PrepareSurface, RefusesWhatCannotBeMeshedAndSaysWhy) {
  expect_refused({}, "no triangles");
  TriMesh nan = test::unit_cube_surface();
  nan.positions[VertId(6)].y = std::numeric_limits<double>::infinity();
  expect_refused(nan, "vertex 6");
  TriMesh line;
  for (int i = 0; i < 9; ++i) line.positions.push_back({1.0 * i, 2.0 * i, 3.0 * i});
  for (int i = 0; i < 7; ++i) line.tris.push_back({VertId(i), VertId(i + 1), VertId(i + 2)});
  expect_refused(line, "without area");
  TriMesh sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.tris = {{VertId(0), VertId(1), VertId(2)}, {VertId(0), VertId(2), VertId(3)}};
  expect_refused(sheet, "flat");
  append(sheet, reversed(sheet), 1, {});
  expect_refused(sheet, "flat");
  expect_refused(test::random_soup(100, 31), "do not join");
  TriMesh point;
  point.positions = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  point.tris = {{VertId(0), VertId(1), VertId(2)}};
  expect_refused(point, "one point");
}

TEST(PrepareSurface, SourceTrianglesLeadBackToTheInput) {
  const TriMesh soup = soup_of(test::unit_cube_surface(), 0);
  const auto p = prepare_surface(reversed(soup), {});
  for (TriId t : p.mesh.tris.ids())
    EXPECT_NEAR(distance((p.mesh.corners(t)[0] + p.mesh.corners(t)[1] + p.mesh.corners(t)[2]) / 3,
                         (soup.corners(p.source_tri[t])[0] + soup.corners(p.source_tri[t])[1] +
                          soup.corners(p.source_tri[t])[2]) /
                             3),
                0, 1e-12);
}

}  // namespace
}  // namespace hexwright
