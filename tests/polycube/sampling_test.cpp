// What makes a cell split: stretch, the size field, the surface's distance, levels.
#include <cmath>

#include <gtest/gtest.h>

#include "hexwright/io/mesh_io.h"
#include "hexwright/polycube/polycube.h"
#include "hexwright/quality/hex_quality.h"
#include "hexwright/quality/surface_distance.h"

#include "polycube/even_lattice.h"
#include "polycube/map/refine_misses.h"
#include "polycube/map/sample_map.h"
#include "polycube/map/surface_misses.h"
#include "polycube/tet_builders.h"

namespace hexwright::polycube {
namespace {

// Everything that sampling looks at, built over one pair.
struct Pair {
  TetMesh object;
  Lattice lattice;
  TetLocator locator;
  BoundaryMap boundary;

  Pair(const TetMesh& cube, const std::function<Vec3(Vec3)>& map)
      : object(test::mapped(cube, map)),
        lattice(fit_lattice(cube, 0)),
        locator(lattice.tets),
        boundary(lattice) {}
  Grid sample(const PolycubeOptions& options) const {
    return sample_map({object, lattice, locator, boundary}, options, {});
  }
};

const std::vector<LatticeCoord> kBar = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};

Vec3 identity(Vec3 p) { return p; }
// The far third is stretched eight times.
Vec3 stretch_end(Vec3 p) { return {p.x > 2 ? 2 + 8 * (p.x - 2) : p.x, p.y, p.z}; }
// A ripple on the upper face of the far third.
Vec3 ripple_end(Vec3 p) {
  const double wave = p.x > 2 ? 0.04 * std::sin(4 * 3.14159265358979 * (p.x - 2)) : 0;
  return {p.x, p.y, p.z * (1 + wave)};
}

int deepest_in(const Grid& grid, double lo, double hi) {
  int deepest = 0;
  for (CellId c : grid.cells.ids()) {
    const double x = cell_box(grid, c).center().x;
    if (x > lo && x < hi) deepest = std::max(deepest, static_cast<int>(grid.cells[c].level));
  }
  return deepest;
}

PolycubeOptions loose_options() {
  PolycubeOptions options;
  options.max_stretch = 10;
  options.max_surface_error = 0;
  options.max_level = 4;
  return options;
}

TEST(SampleMap, NothingAskedNothingSplit) {
  EXPECT_EQ(Pair(test::tet_cubes(kBar, 2), identity).sample(loose_options()).num_cells(), 3u);
}

TEST(SampleMap, StretchSplitsWhereTheMapCompresses) {
  PolycubeOptions options = loose_options();
  options.max_stretch = 0.25;  // the diagonal is about 10.1, a root's 1.7, the far one's 8.1
  const Grid grid = Pair(test::tet_cubes(kBar, 4), stretch_end).sample(options);
  EXPECT_EQ(deepest_in(grid, 0, 2), 0);
  EXPECT_EQ(deepest_in(grid, 2, 3), 2);  // 8.1 -> 4.1 -> 2.1
}

// The criterion is met by every cell of the result, and no cell was split without need.
TEST(SampleMap, StretchIsMetAndNotExceeded) {
  PolycubeOptions options = loose_options();
  options.max_level = 6;
  for (double stretch : {0.4, 0.2, 0.1}) {
    options.max_stretch = stretch;
    const Grid grid = Pair(test::tet_cubes(kBar, 4), stretch_end).sample(options);
    for (CellId c : grid.cells.ids()) {
      const Box3 box = cell_box(grid, c);
      const double width = distance(stretch_end(box.lo), stretch_end(box.hi));
      EXPECT_LE(width, 1.05 * stretch * std::sqrt(102.0));  // 13 directions fall 4% short at most
      const double root = box.extent().x * 2;
      Vec3 parent_lo, parent_hi;
      for (int a = 0; a < 3; ++a) {
        parent_lo[a] = std::floor(box.lo[a] / root + 1e-9) * root;
        parent_hi[a] = parent_lo[a] + root;
      }
      if (grid.cells[c].level > 0) {
        EXPECT_GT(distance(stretch_end(parent_lo), stretch_end(parent_hi)),
                  0.99 * stretch * std::sqrt(102.0));
      }
    }
  }
}

TEST(SampleMap, SizeFieldIsAskedAtObjectPoints) {
  PolycubeOptions options = loose_options();
  options.max_edge = [](const Vec3& p) { return p.x > 2 ? 0.3 : 10.0; };
  const Grid grid = Pair(test::tet_cubes(kBar, 2), identity).sample(options);
  EXPECT_EQ(deepest_in(grid, 0, 2), 0);
  EXPECT_EQ(deepest_in(grid, 2, 3), 2);  // edges 1, 0.5, 0.25
}

TEST(SampleMap, SurfaceErrorSplitsWhereTheSurfaceBends) {
  PolycubeOptions options = loose_options();
  options.max_surface_error = 0.005;
  const Pair pair(test::tet_cubes(kBar, 8), ripple_end);
  const Grid grid = pair.sample(options);
  EXPECT_GE(deepest_in(grid, 2, 3), 2);
  EXPECT_EQ(deepest_in(grid, 0, 1), 0);
  options.max_surface_error = 0.5;
  EXPECT_EQ(pair.sample(options).num_cells(), 3u);
}

TEST(SurfaceMisses, MarksTheCellsOfTheBentFacesOnly) {
  const Pair pair(test::tet_cubes(kBar, 8), ripple_end);
  PolycubeOptions options = loose_options();
  options.min_level = options.max_level = 1;
  const Grid grid = pair.sample(options);
  const auto marks = mark_surface_misses(grid, pair.object, pair.lattice, pair.boundary,
                                         inward_places(pair.lattice.tets), 0.01);
  std::size_t num_marked = 0;
  for (CellId c : grid.cells.ids()) {
    num_marked += marks[c.index()];
    if (marks[c.index()]) {
      EXPECT_GT(cell_box(grid, c).hi.x, 2);
    }
  }
  EXPECT_GE(num_marked, 4u);
}

TEST(RefineMisses, ObjectPointsMarkTheCellsTheyMapInto) {
  const Pair pair(test::tet_cubes(kBar, 2), stretch_end);
  PolycubeOptions options = loose_options();
  options.min_level = options.max_level = 1;
  const Grid grid = pair.sample(options);
  const TetLocator in_object(pair.object);
  // On the far end's corner, which half-open cells do not hold, and at the near end's middle.
  const std::vector<Vec3> points = {{10, 1, 1}, {0, 0.7, 0.2}};
  const auto marks = mark_cells_of_object_points(grid, points, in_object, pair.lattice, 5);
  std::vector<Vec3> centers;
  for (CellId c : grid.cells.ids())
    if (marks[c.index()]) centers.push_back(cell_box(grid, c).center());
  ASSERT_EQ(centers.size(), 2u);
  EXPECT_EQ(centers[0], (Vec3{0.25, 0.75, 0.25}));
  EXPECT_EQ(centers[1], (Vec3{2.75, 0.75, 0.75}));
  const auto none = mark_cells_of_object_points(grid, points, in_object, pair.lattice, 1);
  EXPECT_EQ(std::count(none.begin(), none.end(), 1), 0);
}

TEST(Polycube, MeetsTheDistanceAskedForByItself) {
  const TetMesh cube = test::tet_cubes(kBar, 8);
  const TetMesh object = test::mapped(cube, ripple_end);
  PolycubeOptions options;
  options.max_stretch = 1;
  const PolycubeResult result = mesh_polycube(object, cube, options, {});
  EXPECT_LE(result.report.max_distance, options.max_surface_error);
  EXPECT_NEAR(measure_distance(result.mesh, SurfaceTree(result.surface), {}).max_two_way(),
              result.report.max_distance, 1e-12);
  EXPECT_EQ(summarize_quality(result.mesh).num_inverted, 0u);
  EXPECT_GT(summarize_quality(result.mesh).min_scaled_jacobian, 0.2);
}

// Adaptive sampling keeps what a regular grid of twice the elements loses.
TEST(Polycube, AdaptiveBeatsRegularWhereTheMapCompresses) {
  const std::string stem = std::string(HEXWRIGHT_SOURCE_DIR) + "/data/polycube/finned_head";
  const TetMesh object = read_tet_mesh(stem + "_object.mesh");
  const TetMesh cube = read_tet_mesh(stem + "_polycube.mesh");
  PolycubeOptions regular, adaptive;
  regular.max_surface_error = adaptive.max_surface_error = 0;
  regular.min_level = regular.max_level = 2;
  adaptive.max_stretch = 0.1;
  const auto r = mesh_polycube(object, cube, regular, {});
  const auto a = mesh_polycube(object, cube, adaptive, {});
  EXPECT_EQ(summarize_quality(a.mesh).num_inverted, 0u);
  EXPECT_LT(1.8 * a.mesh.num_hexes(), r.mesh.num_hexes());
  const SurfaceTree surface(r.surface);
  EXPECT_LT(measure_distance(a.mesh, surface, {}).mean_to_mesh,
            0.5 * measure_distance(r.mesh, surface, {}).mean_to_mesh);
}

}  // namespace
}  // namespace hexwright::polycube
