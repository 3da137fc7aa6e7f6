// Building the adaptive grid of a surface.
#include "hexwright/grid/sizing.h"

#include <map>
#include <random>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/geometry/shape_diameter.h"
#include "hexwright/geometry/surface_tree.h"

#include "grid/sizing/box_clip.h"
#include "grid/sizing/sizing_scene.h"
#include "helpers.h"

namespace hexwright {

using namespace grids;

namespace {

/// The unit sphere with its vertices welded.
TriMesh sphere(int depth) {
  const TriMesh soup = test::unit_sphere_surface(depth);
  TriMesh welded;
  std::map<std::array<double, 3>, VertId> ids;
  for (TriId t : soup.tris.ids()) {
    std::array<VertId, 3> tri;
    const std::array<Vec3, 3> corners = soup.corners(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = corners[k];
      const auto [it, is_new] = ids.try_emplace({p.x, p.y, p.z}, VertId(welded.num_verts()));
      if (is_new) welded.positions.push_back(p);
      tri[k] = it->second;
    }
    welded.tris.push_back(tri);
  }
  return welded;
}

FeatureGraph features_of(const TriMesh& surface) { return extract_features(surface, {}); }

SizingResult build(const TriMesh& surface, const SizingOptions& options) {
  return build_grid(SurfaceTree(surface), features_of(surface), options, {});
}

/// A box of 2 x 2 x `height`.
TriMesh slab(double height) {
  TriMesh s = test::unit_cube_surface();
  for (Vec3& p : s.positions) p = {2 * p.x, 2 * p.y, height * p.z};
  return s;
}

TEST(Sizing, RootCubeIsCentredWithItsMargin) {
  const GridFrame frame = root_frame({{0, 0, 0}, {4, 2, 1}}, 0.02);
  EXPECT_DOUBLE_EQ(frame.root_size, 4 * 1.04);
  EXPECT_NEAR(distance(frame.origin + Vec3{1, 1, 1} * (frame.root_size / 2), {2, 1, 0.5}), 0,
              1e-12);
}

TEST(Sizing, GridsTileTheRootAndKeepToTheLevels) {
  SizingOptions options;
  options.min_level = 3;
  options.max_level = 5;
  const SizingResult r = build(sphere(4), options);
  EXPECT_FALSE(r.grid.find_problem());
  EXPECT_LE(r.grid.finest_level, 5);
  EXPECT_EQ(r.reached_level, r.grid.finest_level);
  const SurfaceTree tree(sphere(4));
  for (CellId c : r.grid.cells.ids()) {
    const Box3 box = cell_box(r.grid, c);
    if (tree.distance(box.center()) < 0.5 * box.extent().x) {  // the surface passes through
      EXPECT_GE(r.grid.cells[c].level, 3);
    }
  }
}

TEST(Sizing, ACubeNeedsNoMoreThanTheMinimumLevel) {
  const SizingResult r = build(test::unit_cube_surface(), {});
  EXPECT_EQ(r.grid.num_cells(), 64u);  // flat faces, far walls: level 2 throughout
}

TEST(Sizing, CountsNeverFallWhenTheToleranceDoes) {
  for (const TriMesh& surface : {sphere(4), slab(0.6)}) {
    std::size_t last = 0;
    for (double tolerance : {0.04, 0.02, 0.01, 0.007, 0.005, 0.003}) {
      SizingOptions options;
      options.tolerance = tolerance;
      const std::size_t count = build(surface, options).grid.num_cells();
      EXPECT_GE(count, last) << "tolerance " << tolerance;
      last = count;
    }
  }
}

TEST(Sizing, CurvedSurfacesAreSplitUntilTheirCellsAreNearlyFlat) {
  SizingOptions options;
  options.tolerance = 0.005;
  options.min_edge = 0;
  const SizingResult r = build(sphere(5), options);
  // In a leaf of edge h a unit sphere departs from a plane by at most about (sqrt(3) h)^2 / 8.
  const double spread = options.deviation_factor * options.tolerance * 2 * std::sqrt(3.0);
  const double h = r.grid.frame.root_size / (1 << r.grid.finest_level);
  EXPECT_GT(3 * (4 * h * h) / 8, spread / 2) << "finer than needed";
  EXPECT_LT(h * h / 8, spread) << "coarser than allowed";
  EXPECT_GT(r.splits_by_reason[1], 0u);
}

TEST(Sizing, ThinWallsAreResolved) {
  const SizingResult r = build(slab(0.1), {});
  EXPECT_GT(r.splits_by_reason[2], 0u);
  const double h = r.grid.frame.root_size / (1 << r.grid.finest_level);
  EXPECT_LE(0.75 * h, 0.1);
  EXPECT_GT(0.75 * 2 * h, 0.1);
}

TEST(Sizing, ThicknessMeetsThePapersCriterion) {
  const TriMesh surface = sphere(3);
  SizingOptions options;
  options.sizing = Sizing::Thickness;
  options.min_level = 0;
  const SizingResult r = build(surface, options);
  const auto diameter = compute_shape_diameter(surface, {}, {});
  for (CellId c : r.grid.cells.ids()) {
    const Box3 box = cell_box(r.grid, c);
    const NodeCube node{box.center(), box.extent().x, box.extent()};
    double least = 1e300;
    for (TriId t : surface.tris.ids())
      if (meets_cube(node.to_local(surface.corners(t)), 0.5)) least = std::min(least, diameter[t]);
    EXPECT_LE(node.edge, least / 2 * (1 + 1e-9));
  }
}

TEST(Sizing, TheBudgetStopsAtAWholeLevelWithAMessage) {
  SizingOptions options;
  options.tolerance = 0.001;
  options.max_cells = 3000;
  std::string message;
  Context context;
  context.on_warning = [&](std::string_view m) { message = m; };
  const TriMesh surface = sphere(4);
  const SizingResult r = build_grid(SurfaceTree(surface), features_of(surface), options, context);
  EXPECT_TRUE(r.hit_cell_budget);
  EXPECT_LE(r.grid.num_cells(), 3000u);
  EXPECT_NE(message.find("budget of 3000"), std::string::npos) << message;
  // A whole level: symmetric like the sphere, so that every octant has as many cells.
  std::array<int, 8> octant{};
  for (CellId c : r.grid.cells.ids()) {
    const Vec3 p = cell_box(r.grid, c).center();
    ++octant[static_cast<std::size_t>((p.x > 0) + 2 * (p.y > 0) + 4 * (p.z > 0))];
  }
  for (int count : octant) EXPECT_EQ(count, octant[0]);
}

TEST(Sizing, ResultsDoNotDependOnThreadsOrScale) {
  const TriMesh surface = sphere(4);
  SizingOptions options;
  options.crease_proximity = 0.75;
  const Grid one = [&] {
    const ThreadLimit limit(1);
    return build(surface, options).grid;
  }();
  const ThreadLimit limit(2);
  EXPECT_EQ(build(surface, options).grid.cells, one.cells);
  TriMesh moved = surface;  // by powers of two, so that nothing rounds
  for (Vec3& p : moved.positions) p = p * 0x1p-30;
  EXPECT_EQ(build(moved, options).grid.cells, one.cells);
}

TEST(Sizing, CrowdedCornersAreSplitInASinglePass) {
  SizingOptions options;
  options.max_level = 5;
  const TriMesh surface = slab(0.5);
  const std::size_t plain = build(surface, options).grid.num_cells();
  options.crease_proximity = 0.75;
  const SizingResult r = build(surface, options);
  EXPECT_GT(r.splits_by_reason[4], 0u);
  EXPECT_GT(r.grid.num_cells(), plain);
}

TEST(Sizing, RejectsOptionsOutOfRange) {
  const TriMesh cube = test::unit_cube_surface();
  SizingOptions options;
  options.tolerance = 0;
  EXPECT_THROW(build(cube, options), Error);
  options = {};
  options.min_level = 5;
  options.max_level = 4;
  EXPECT_THROW(build(cube, options), Error);
  EXPECT_THROW(build_grid(SurfaceTree(TriMesh{}), {}, {}, {}), Error);
}

TEST(PlaneSpread, IsZeroOnPlanesAndSeparatesSheets) {
  const TriMesh cube = test::unit_cube_surface();
  const FeatureGraph features = features_of(cube);
  SizingOptions options;
  options.wall_factor = 0;
  const SurfaceTree tree(cube);
  const SizingScene scene = make_sizing_scene(tree, features, options, {});
  std::vector<TriId> all;
  for (TriId t : cube.tris.ids()) all.push_back(t);
  // The whole cube in one node: six faces apart, each flat.
  EXPECT_NEAR(compute_plane_spread(scene, {{0.5, 0.5, 0.5}, 1.3}, all), 0, 1e-12);
  // Without creases the faces are one group and far from any plane.
  const SizingScene smooth = make_sizing_scene(tree, {}, options, {});
  const double spread = compute_plane_spread(smooth, {{0.5, 0.5, 0.5}, 1.0}, all);
  EXPECT_GE(spread, 1 - 1e-12);
  EXPECT_LE(spread, std::sqrt(3.0) + 1e-12);
}

TEST(MarkCells, MarksTheLeavesThatHoldThePoints) {
  const Grid grid = build(sphere(3), {}).grid;
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  std::vector<Vec3> points;
  for (int k = 0; k < 50; ++k) points.push_back({u(rng), u(rng), u(rng)});
  const auto marks = mark_cells_with_points(grid, points, 20);
  for (CellId c : grid.cells.ids()) {
    bool expected = false;
    for (const Vec3& p : points) expected |= cell_box(grid, c).contains(p);
    EXPECT_EQ(marks[c.index()] != 0, expected);
  }
  const auto capped = mark_cells_with_points(grid, points, grid.finest_level);
  for (CellId c : grid.cells.ids())
    if (capped[c.index()]) {
      EXPECT_LT(grid.cells[c].level, grid.finest_level);
    }
  const std::vector<Vec3> outside = {{50, 0, 0}, {0, 0, 1e300}};
  for (char m : mark_cells_with_points(grid, outside, 20)) EXPECT_EQ(m, 0);
}

}  // namespace
}  // namespace hexwright
