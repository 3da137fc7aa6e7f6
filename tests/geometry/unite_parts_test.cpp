// Solids that overlap, touch, lie in each other, or share faces, made into their union.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "hexwright/base/parallel.h"
#include "hexwright/geometry/prepare_surface.h"
#include "hexwright/geometry/surface_topology.h"

#include "fit/fit_helpers.h"
#include "geometry/tree/triangle_contacts.h"
#include "mesh/tri_measures.h"
#include "solids.h"

namespace hexwright {
namespace {

using test::box_surface;
using test::reversed;

/// As in a file, a name for each part.
TriMesh joined(const std::vector<TriMesh>& parts) {
  TriMesh all;
  for (const TriMesh& part : parts) {
    append(all, part);
    all.group.resize(all.num_tris(), static_cast<std::int32_t>(all.group_names.size()));
    all.group_names.push_back("part " + std::to_string(all.group_names.size()));
  }
  return all;
}

/// Equal positions are one vertex, as STL readers make them.
TriMesh joined(const std::vector<TriMesh>& parts, bool is_welded) {
  return is_welded ? test::welded(test::joined(parts)) : joined(parts);
}

/// The triangles of the input, each once, in whatever order.
void expect_as_given(const PreparedSurface& p, const TriMesh& input) {
  ASSERT_EQ(p.mesh.num_tris(), input.num_tris());
  EXPECT_EQ(p.mesh.num_verts(), input.num_verts());
  std::vector<char> is_met(input.num_tris(), 0);
  for (TriId t : p.mesh.tris.ids()) {
    const TriId source = p.source_tri[t];
    ASSERT_TRUE(source.is_valid());
    EXPECT_FALSE(std::exchange(is_met[source.index()], 1));
    auto now = p.mesh.corners(t);
    const auto then = input.corners(source);
    std::rotate(now.begin(), std::find(now.begin(), now.end(), then[0]), now.end());
    EXPECT_EQ(now, then);
  }
}

/// A box with a slit of no width from one side to its middle, whose walls have other vertices: one
/// is whole, the other in three pieces.
TriMesh slit_box() {
  const std::vector<Vec3> outline = {{0, 0, 0}, {10, 0, 0}, {10, 5, 0},  {8.1, 5, 0}, {5.3, 5, 0},
                                     {3, 5, 0}, {10, 5, 0}, {10, 10, 0}, {0, 10, 0}};
  TriMesh mesh;
  const std::size_t n = outline.size();
  for (const double z : {0.0, 4.0})
    for (const Vec3& p : outline) mesh.positions.push_back({p.x, p.y, z});
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    mesh.tris.push_back({VertId(a), VertId(b), VertId(c)});
  };
  for (const auto& [a, b, c] : {std::array<std::size_t, 3>{0, 1, 2},
                                {0, 2, 3},
                                {0, 3, 4},
                                {0, 4, 5},
                                {0, 5, 8},
                                {5, 7, 8},
                                {5, 6, 7}}) {
    add(n + a, n + b, n + c);
    add(c, b, a);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    add(i, j, n + j);
    add(i, n + j, n + i);
  }
  return test::welded(mesh);
}

/// A closed two-manifold of the given volume, components and genus.
void expect_solid(const PreparedSurface& p, double expected_volume, std::size_t num_components,
                  long genus = 0) {
  EXPECT_FALSE(p.mesh.find_problem());
  const SurfaceTopology topology = compute_topology(p.mesh);
  EXPECT_TRUE(topology.is_closed_manifold());
  EXPECT_TRUE(is_oriented_cycle(p.mesh));
  EXPECT_EQ(topology.num_components, num_components);
  EXPECT_EQ(topology.genus(), genus);
  EXPECT_NEAR(enclosed_volume(p.mesh), expected_volume, 1e-9 * expected_volume);
  EXPECT_EQ(p.source_tri.size(), p.mesh.num_tris());
}

const TriMesh kPlate = box_surface({0, 0, 0}, {10, 10, 2}),
              kPost = box_surface({3, 3, -1}, {7, 7, 9});

TEST(CloseSlits, ASlitWithoutWidthIsClosedAndSaid) {
  for (const double angle : {0.0, 0.3}) {
    TriMesh surface = slit_box();
    for (Vec3& p : surface.positions)  // rounded as in a file of single precision
      p = {static_cast<float>(std::cos(angle) * p.x - std::sin(angle) * p.y),
           static_cast<float>(std::sin(angle) * p.x + std::cos(angle) * p.y), p.z};
    const PreparedSurface closed = prepare_surface(surface, {});
    const SurfaceTopology topology = compute_topology(closed.mesh);
    EXPECT_TRUE(topology.is_closed_manifold());
    EXPECT_EQ(topology.num_components, 1u);
    EXPECT_EQ(topology.genus(), 0);
    EXPECT_NEAR(enclosed_volume(closed.mesh), 400, 1e-3);
    EXPECT_TRUE(std::ranges::any_of(closed.diagnosis.notes, [](const std::string& note) {
      return note.find("slits without width closed") != std::string::npos;
    }));
    const PreparedSurface kept = prepare_surface(surface, {.parts = Parts::Separate}, {});
    EXPECT_FALSE(compute_topology(kept.mesh).is_closed_manifold());
  }
}

TEST(UniteParts, CrossingBoxesBecomeOne) {
  const TriMesh input = joined({kPlate, kPost});
  const PreparedSurface p = prepare_surface(input, {});
  expect_solid(p, 200 + 16 * 10 - 16 * 2, 1);
  EXPECT_EQ(p.mesh.num_verts(), 24u);  // 8 where faces cross, none inside faces
  EXPECT_EQ(p.diagnosis.num_united_parts, 2u);
  EXPECT_EQ(p.diagnosis.num_unions, 1u);
  ASSERT_EQ(p.diagnosis.notes.size(), 1u);
  EXPECT_EQ(p.diagnosis.notes[0], "2 parts that overlap or touch united into 1");
  EXPECT_TRUE(p.diagnosis.warnings.empty());
}

/// Two blocks on each other, of which the upper one's lower face leans into the lower one at one
/// side and leaves a gap at the other.
TriMesh leaning_blocks(double gap) {
  TriMesh upper = box_surface({0, 0, 4}, {10, 10, 8});
  for (Vec3& p : upper.positions)
    if (p.z == 4) p.z += gap * (p.x / 8 - 0.25);
  return joined({box_surface({0, 0, 0}, {10, 10, 4}), upper});
}

TEST(UniteParts, GapsOfWallsThatNearlyCoincideAreClosed) {
  const double diagonal = norm(Vec3{10, 10, 8});
  for (const double gap : {0.2, 0.7, 20.0}) {
    const double widest = gap * 1e-3 * diagonal;
    const TriMesh input = leaning_blocks(widest);
    for (const double min_gap : {0.0, 1e-3}) {
      const PreparedSurface p = prepare_surface(input, {.min_gap = min_gap}, {});
      const bool is_closed = gap * 1e-3 < min_gap;
      EXPECT_EQ(p.diagnosis.num_gaps_closed, is_closed ? 1u : 0u) << gap << " " << min_gap;
      const SurfaceTopology topology = compute_topology(p.mesh);
      EXPECT_TRUE(topology.is_closed_manifold());
      EXPECT_EQ(topology.num_components, 1u);
      EXPECT_EQ(topology.genus(), 0);
      EXPECT_NEAR(enclosed_volume(p.mesh), 800 - (is_closed ? 0 : 40 * widest), 0.05);
      EXPECT_NEAR(total_area(p.mesh), 2 * 100 + 4 * 80 + (is_closed ? 0 : 160), 10);
      const auto& said = p.diagnosis.warnings;
      EXPECT_EQ(std::ranges::any_of(
                    said, [](const std::string& w) { return w.find("nearly coincide") != w.npos; }),
                is_closed);
    }
  }
}

TEST(UniteParts, EveryTriangleKeepsItsNameAndPlane) {
  const TriMesh input = joined({kPlate, kPost});
  const PreparedSurface p = prepare_surface(input, {});
  ASSERT_EQ(p.mesh.group.size(), p.mesh.num_tris());
  for (TriId t : p.mesh.tris.ids()) {
    ASSERT_TRUE(p.source_tri[t].is_valid());
    EXPECT_EQ(p.mesh.group[t], input.group[p.source_tri[t]]);
    const auto from = input.corners(p.source_tri[t]);
    const Vec3 n = normalized(cross(from[1] - from[0], from[2] - from[0]));
    for (const Vec3& c : p.mesh.corners(t)) EXPECT_NEAR(dot(n, c - from[0]), 0, 1e-12);
  }
}

TEST(UniteParts, NamesThatPartAPlaneStayApart) {
  TriMesh input = joined({kPlate, kPost});
  input.group_names = {"plate", "post", "mark"};
  input.group[TriId(10)] = 2;  // half of the plate's top
  const PreparedSurface p = prepare_surface(input, {});
  double area = 0;
  for (TriId t : p.mesh.tris.ids()) {
    const auto c = p.mesh.corners(t);
    if (p.mesh.group[t] == 2) area += norm(cross(c[1] - c[0], c[2] - c[0])) / 2;
  }
  EXPECT_NEAR(area, 50 - 8, 1e-9);
}

TEST(UniteParts, TouchingBoxesBecomeOneHoweverTheirVerticesAreShared) {
  for (bool is_welded : {false, true}) {
    expect_solid(prepare_surface(
                     joined({box_surface({0, 0, 0}, {2, 2, 2}), box_surface({2, 0, 0}, {5, 2, 2})},
                            is_welded),
                     {}),
                 20, 1);
    expect_solid(prepare_surface(
                     joined({box_surface({0, 0, 0}, {2, 4, 2}), box_surface({2, 1, 0}, {5, 2, 1})},
                            is_welded),
                     {}),
                 19, 1);
  }
}

TEST(UniteParts, CubesThatTouchAlongAnEdgeStayTwo) {
  const TriMesh input =
      joined({box_surface({0, 0, 0}, {1, 1, 1}), box_surface({1, 1, 0}, {2, 2, 1})}, true);
  const PreparedSurface p = prepare_surface(input, {});
  expect_solid(p, 2, 2, 0);
  EXPECT_EQ(p.diagnosis.num_nonmanifold_edges, 0u);
}

TEST(UniteParts, ShellsThatShareTrianglesComeApart) {
  // Two boxes on the same floor: equal triangles in equal orientation, one for each.
  const TriMesh low = box_surface({0, 0, 0}, {1, 1, 1}), high = box_surface({0, 0, 0}, {1, 1, 2});
  expect_solid(prepare_surface(joined({low, high}, true), {}), 2, 1);
  // The same box twice, through the top of another.
  const TriMesh large = box_surface({0, 0, 0}, {4, 4, 4}), post = box_surface({1, 1, 1}, {2, 2, 5});
  expect_solid(prepare_surface(joined({large, post, post}, true), {}), 64 + 1, 1);
}

TEST(UniteParts, CavitiesStayAndWhatLiesInThemToo) {
  const TriMesh shell = box_surface({0, 0, 0}, {10, 10, 10}),
                cavity = reversed(box_surface({2, 2, 2}, {8, 8, 8}));
  const TriMesh core = box_surface({4, 4, 4}, {6, 6, 6});
  const PreparedSurface apart = prepare_surface(joined({shell, cavity, core}), {});
  expect_solid(apart, 1000 - 216 + 8, 3);
  EXPECT_EQ(apart.diagnosis.num_united_parts, 0u);
  // A post on the shell leaves the cavity alone.
  const TriMesh post = box_surface({4, 4, 9}, {6, 6, 12});
  expect_solid(prepare_surface(joined({shell, cavity, core, post}), {}), 1000 - 216 + 8 + 4 * 2, 3);
  // One that reaches into it ends in it.
  const TriMesh long_post = box_surface({4.5, 4.5, 7}, {5.5, 5.5, 12});
  expect_solid(prepare_surface(joined({shell, cavity, core, long_post}), {}),
               1000 - 216 + 8 + 1 + 2, 3);
}

TEST(UniteParts, WhatDoesNotMeetStaysToTheLastTriangle) {
  const TriMesh input =
      joined({box_surface({0, 0, 0}, {1, 1, 1}), box_surface({1.5, 0, 0}, {2, 1, 1})});
  const PreparedSurface p = prepare_surface(input, {});
  expect_as_given(p, input);
  EXPECT_TRUE(p.diagnosis.notes.empty());
}

TEST(UniteParts, SeparateJoinsOverlapsOnlyAndAsIsNothing) {
  PrepareOptions options;
  options.parts = Parts::Separate;
  const TriMesh touching =
      joined({box_surface({0, 0, 0}, {2, 4, 2}), box_surface({2, 1, 0}, {5, 2, 1})});
  EXPECT_EQ(compute_topology(prepare_surface(touching, options, {}).mesh).num_components, 2u);
  const TriMesh crossing = joined({kPlate, kPost});
  expect_solid(prepare_surface(crossing, options, {}), 328, 1);
  options.parts = Parts::AsIs;
  expect_as_given(prepare_surface(crossing, options, {}), crossing);
}

TEST(UniteParts, IsTheSameForAnyNumberOfThreads) {
  std::vector<TriMesh> parts;
  for (int i = 0; i < 6; ++i)
    parts.push_back(test::cylinder_surface(0.3 * i, 1, 0.1 * i, 3 + 0.2 * i, 40));
  const TriMesh input = joined(parts);
  const PreparedSurface reference = prepare_surface(input, {});
  EXPECT_EQ(reference.diagnosis.num_united_parts, 6u);
  for (int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    const PreparedSurface again = prepare_surface(input, {});
    EXPECT_EQ(again.mesh.positions, reference.mesh.positions);
    EXPECT_EQ(again.mesh.tris, reference.mesh.tris);
  }
}

TEST(UniteParts, VerticesOfTheInputKeepTheirPlaces) {
  TriMesh input = joined({kPlate, kPost});
  for (Vec3& p : input.positions) p = p * 1e-3 + Vec3{0.1, 0.7, 1.3};
  const PreparedSurface p = prepare_surface(input, {});
  std::size_t num_kept = 0;
  for (const Vec3& x : p.mesh.positions)
    num_kept +=
        std::find(input.positions.begin(), input.positions.end(), x) != input.positions.end();
  EXPECT_EQ(num_kept, 16u);
}

TEST(SmallParts, CrevicesThatNoCellResolvesAreFilled) {
  const auto with_void = [](double height) {
    return joined({box_surface({0, 0, 0}, {10, 10, 10}),
                   reversed(box_surface({3, 3, 5}, {7, 7, 5 + height}))});
  };
  PrepareOptions options;
  options.min_part = 0.005;
  const PreparedSurface filled = prepare_surface(with_void(0.002), options, {});
  expect_solid(filled, 1000, 1);
  EXPECT_EQ(filled.diagnosis.num_small_voids, 1u);
  const PreparedSurface kept = prepare_surface(with_void(0.05), options, {});
  expect_solid(kept, 1000 - 16 * 0.05, 2);
}

TEST(SmallParts, AreLeftOutWithTheirPlace) {
  const TriMesh input =
      joined({box_surface({0, 0, 0}, {10, 10, 10}), box_surface({12, 0, 0}, {12.01, 0.01, 0.01}),
              reversed(box_surface({5, 5, 5}, {5.01, 5.01, 5.01}))});
  PrepareOptions options;
  options.min_part = 0.005;
  const PreparedSurface p = prepare_surface(input, options, {});
  expect_solid(p, 1000, 1);
  EXPECT_EQ(p.diagnosis.num_small_parts, 1u);
  EXPECT_EQ(p.diagnosis.num_small_voids, 1u);
  ASSERT_EQ(p.diagnosis.warnings.size(), 1u);
  EXPECT_NE(p.diagnosis.warnings[0].find("(12, 0.005, 0.005), 0.01 long"), std::string::npos)
      << p.diagnosis.warnings[0];
  EXPECT_EQ(prepare_surface(input, {}).mesh.num_tris(), 36u);  // all kept without the option
  options.min_part = 0.9;                                      // never all of it
  EXPECT_EQ(prepare_surface(input, options, {}).mesh.num_tris(), 36u);
}

TEST(TriangleContacts, CrossingNeedsDepthAndTouchingOnlyNearness) {
  const Corners floor = {Vec3{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const Corners pin = {Vec3{1, 1, -1}, {1, 1, 1}, {1.5, 1, 1}};
  const auto at = find_crossing(floor, pin, 1e-6);
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->z, 0, 1e-15);
  Corners above = pin;
  for (Vec3& p : above) p.z += 1 + 1e-4;
  EXPECT_FALSE(find_crossing(floor, above, 1e-6));
  EXPECT_FALSE(are_within(floor, above, 1e-5));
  EXPECT_TRUE(are_within(floor, above, 1e-3));
  // Two edges that pass each other, far from all vertices.
  const Corners bridge = {Vec3{-3, 1, 0.01}, {5, 1, 0.01}, {1, 1, 9}};
  EXPECT_FALSE(find_crossing(floor, bridge, 0));
  EXPECT_TRUE(are_within(floor, bridge, 0.02));
  EXPECT_FALSE(are_within(floor, bridge, 0.005));
}

TEST(TriangleContacts, NearPairsAreThoseOfBruteForce) {
  const TriMesh mesh = joined(
      {test::cylinder_surface(0, 1, 0, 2, 24), kPost, test::cylinder_surface(3, 1.5, -2, 4, 31)});
  const auto meets = [&](TriId a, TriId b) {
    return are_within(mesh.corners(a), mesh.corners(b), 0.1);
  };
  const std::vector<TriPair> found = find_near_pairs(mesh, 0.1, meets);
  std::size_t k = 0;
  for (TriId a : mesh.tris.ids())
    for (TriId b : mesh.tris.ids()) {
      if (!(a < b) || !meets(a, b)) continue;
      ASSERT_LT(k, found.size());
      EXPECT_TRUE(found[k].a == a && found[k].b == b);
      ++k;
    }
  EXPECT_EQ(k, found.size());
}

}  // namespace
}  // namespace hexwright
