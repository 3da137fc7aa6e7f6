// Lattices found again in moved and stretched polycubes, charts merged, maps carried back, and what
// sampling must not depend on.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/grid/locate.h"
#include "hexwright/polycube/polycube.h"
#include "hexwright/quality/hex_quality.h"

#include "geometry/random_soup.h"
#include "helpers.h"
#include "polycube/even_lattice.h"
#include "polycube/lattice/merge_charts.h"
#include "polycube/map/map_back.h"
#include "polycube/map/refine_misses.h"
#include "polycube/map/sample_map.h"
#include "polycube/tet_builders.h"
#include "polycube/tets/unfold.h"

namespace hexwright::polycube {
namespace {

const std::vector<LatticeCoord> kL = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

/// Cubes of a 4 x 3 x 2 block grown at random from one corner cube, face to face.
std::vector<LatticeCoord> grown_cubes(std::size_t count, std::mt19937_64& random) {
  std::vector<LatticeCoord> cubes = {{0, 0, 0}};
  const LatticeCoord size = {4, 3, 2};
  while (cubes.size() < count) {
    LatticeCoord next = cubes[random() % cubes.size()];
    const std::size_t axis = random() % 3;
    next[axis] += random() % 2 ? 1 : -1;
    const bool is_inside = next[axis] >= 0 && next[axis] < size[axis];
    if (is_inside && std::find(cubes.begin(), cubes.end(), next) == cubes.end())
      cubes.push_back(next);
  }
  return cubes;
}

/// Moved so that the least index along each axis is zero, in the lattice's order.
std::vector<LatticeCoord> normalized_roots(std::vector<LatticeCoord> cubes) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    int least = cubes[0][axis];
    for (const auto& c : cubes) least = std::min(least, c[axis]);
    for (auto& c : cubes) c[axis] -= least;
  }
  std::sort(cubes.begin(), cubes.end(), [](const LatticeCoord& a, const LatticeCoord& b) {
    return std::tie(a[2], a[1], a[0]) < std::tie(b[2], b[1], b[0]);
  });
  return cubes;
}

void expect_vertices_on_planes(const Lattice& lattice) {
  for (TriId f : lattice.facets.ids()) {
    const Chart& chart = lattice.charts[static_cast<std::size_t>(lattice.facet_to_chart[f])];
    for (VertId v : lattice.facets[f])
      EXPECT_EQ(lattice.tets.positions[v][chart.axis], chart.plane);
  }
}

// The cubes come back whatever the polycube's units, place, and the order of its axes.
TEST(Lattice, FindsTheCubesOfMovedScaledAndTurnedPolycubes) {
  std::mt19937_64 random(41);
  for (int round = 0; round < 12; ++round) {
    const auto cubes = grown_cubes(3 + random() % 8, random);
    const TetMesh mesh = test::tet_cubes(cubes, 2);
    const auto expected = normalized_roots(cubes);
    for (double scale : {1e-4, 1.0, 25.4, 1e6}) {
      const Vec3 shift = test::random_point(random, 10);
      const Lattice lattice =
          fit_lattice(test::mapped(mesh, [&](Vec3 p) { return (p + shift) * scale; }), scale);
      EXPECT_EQ(lattice.roots, expected) << "round " << round << ", scale " << scale;
      EXPECT_LT(lattice.max_deviation, 1e-9);
      expect_vertices_on_planes(lattice);
    }
    // x -> y -> z -> x keeps the tets positive.
    std::vector<LatticeCoord> turned;
    for (const auto& c : cubes) turned.push_back({c[2], c[0], c[1]});
    EXPECT_EQ(fit_lattice(test::mapped(mesh,
                                       [](Vec3 p) {
                                         return Vec3{p.z, p.x, p.y};
                                       }),
                          1)
                  .roots,
              normalized_roots(turned));
  }
}

// A boundary that is not quite flat, as deformations leave it: the planes are the same and the
// deviation is what was put in.
TEST(Lattice, ToleratesABoundaryThatIsNearlyFlat) {
  std::mt19937_64 random(42);
  for (double noise : {1e-6, 1e-3, 0.02}) {
    const auto cubes = grown_cubes(6, random);
    const TetMesh rough = test::mapped(
        test::tet_cubes(cubes, 2), [&](Vec3 p) { return p + test::random_point(random, noise); });
    const Lattice lattice = fit_lattice(rough, 1);
    EXPECT_EQ(lattice.roots, normalized_roots(cubes)) << noise;
    EXPECT_GT(lattice.max_deviation, 0.2 * noise);
    EXPECT_LT(lattice.max_deviation, 3 * noise);
    expect_vertices_on_planes(lattice);
  }
}

/// Facets across the sides of each facet, by a map over all edges.
IdVector<TriId, std::array<TriId, 3>> neighbors_of(const Lattice& lattice) {
  std::map<std::set<VertId>, std::vector<TriId>> by_edge;
  const auto side = [&](TriId t, std::size_t k) {
    return std::set<VertId>{lattice.facets[t][k], lattice.facets[t][(k + 1) % 3]};
  };
  for (TriId t : lattice.facets.ids())
    for (std::size_t k = 0; k < 3; ++k) by_edge[side(t, k)].push_back(t);
  IdVector<TriId, std::array<TriId, 3>> neighbor(lattice.facets.size());
  for (TriId t : lattice.facets.ids())
    for (std::size_t k = 0; k < 3; ++k)
      for (TriId other : by_edge[side(t, k)])
        if (other != t) neighbor[t][k] = other;
  return neighbor;
}

std::vector<double> chart_areas(const Lattice& lattice) {
  std::vector<double> area(lattice.charts.size(), 0);
  const auto& x = lattice.tets.positions;
  for (TriId t : lattice.facets.ids()) {
    const auto& f = lattice.facets[t];
    area[static_cast<std::size_t>(lattice.facet_to_chart[t])] +=
        norm(cross(x[f[1]] - x[f[0]], x[f[2]] - x[f[0]])) / 2;
  }
  return area;
}

// What remains is large enough for the spacing, numbered without gaps, and the area is still all
// there. Nothing is left to merge.
TEST(MergeCharts, LeavesOnlyChartsThatTheLatticeCanShow) {
  std::mt19937_64 random(43);
  int num_merged_in_all = 0;
  for (int round = 0; round < 10; ++round)
    for (double spacing : {1.0, 2.5, 3.5}) {
      Lattice lattice = fit_lattice(test::tet_cubes(grown_cubes(8, random), 1), 1);
      for (Chart& chart : lattice.charts) chart.coordinate = chart.plane;
      const auto neighbor = neighbors_of(lattice);
      const auto before = chart_areas(lattice);
      const std::size_t num_charts = lattice.charts.size();
      const std::size_t num_small = static_cast<std::size_t>(std::count_if(
          before.begin(), before.end(), [&](double a) { return a < spacing * spacing / 4; }));
      const std::size_t num_merged = merge_small_charts(lattice, neighbor, spacing);
      const auto after = chart_areas(lattice);
      EXPECT_LE(num_merged, num_small);
      EXPECT_LE(lattice.charts.size() + num_merged, num_charts);
      EXPECT_NEAR(std::accumulate(after.begin(), after.end(), 0.0),
                  std::accumulate(before.begin(), before.end(), 0.0), 1e-9);
      for (double a : after) EXPECT_GE(a, spacing * spacing / 4 - 1e-9);
      EXPECT_EQ(merge_small_charts(lattice, neighbor, spacing), 0u);
      num_merged_in_all += static_cast<int>(num_merged);
      EXPECT_TRUE(spacing > 1 || num_merged == 0);  // every face of a cube is a whole square
    }
  EXPECT_GT(num_merged_in_all, 10);
}

/// The L of three cubes as hexes, n per cube and axis, in lattice units.
HexMesh l_shaped_hexes(int n) {
  HexMesh box = test::box_hex_mesh(2 * n, 2 * n, n), mesh;
  std::map<VertId, VertId> renumbered;
  for (HexId h : box.hexes.ids()) {
    const Vec3 low = box.corners(h)[0];
    if (low.x >= n && low.y >= n) continue;
    std::array<VertId, 8> hex;
    for (std::size_t k = 0; k < 8; ++k) {
      const auto [it, is_new] = renumbered.try_emplace(box.hexes[h][k]);
      if (is_new) it->second = mesh.positions.push_back(box.positions[box.hexes[h][k]] / double(n));
      hex[k] = it->second;
    }
    mesh.hexes.push_back(hex);
  }
  return mesh;
}

// The identity carries every vertex to itself, an affine map to its affine image, and every vertex
// stands for what it lies on.
TEST(MapBack, CarriesAffineMapsExactly) {
  const TetMesh polycube = test::tet_cubes(kL, 2);
  const Lattice lattice = fit_lattice(polycube, 0);
  const TetLocator locator(lattice.tets);
  const HexMesh hexes = l_shaped_hexes(3);  // not the tets' own vertices
  for (bool is_identity : {true, false}) {
    const auto map = [&](Vec3 p) {
      return is_identity ? p : Vec3{3 * p.x + p.y + 7, 2 * p.y - 0.5 * p.z, p.z + 0.25 * p.x - 100};
    };
    const MappedMesh mapped = map_back(hexes, test::mapped(polycube, map), lattice, locator);
    EXPECT_EQ(mapped.num_bridged, 0u);
    EXPECT_EQ(mapped.mesh.hexes, hexes.hexes);
    std::size_t num_corners = 0;
    for (VertId v : hexes.positions.ids()) {
      const Vec3& p = hexes.positions[v];
      EXPECT_NEAR(distance(mapped.mesh.positions[v], map(p)), 0, 1e-12) << v.value();
      // How many of the L's planes the vertex lies on tells what it stands for. In the inner angle
      // x = 1 and y = 1 are planes too.
      const bool by_x = p.x == 0 || p.x == 2 || (p.x == 1 && p.y >= 1);
      const bool by_y = p.y == 0 || p.y == 2 || (p.y == 1 && p.x >= 1);
      const int num_planes = by_x + by_y + (p.z == 0 || p.z == 1);
      const BoundaryPlace& place = mapped.place[v];
      EXPECT_EQ(place.facet.is_valid(), num_planes == 1);
      EXPECT_EQ(place.crease[0].is_valid(), num_planes == 2);
      EXPECT_EQ(place.corner.is_valid(), num_planes == 3);
      num_corners += place.corner.is_valid();
    }
    EXPECT_EQ(num_corners, 12u);
  }
}

TEST(MapBack, DoesNotDependOnThreads) {
  const TetMesh polycube = test::tet_cubes(kL, 3);
  const TetMesh object = test::mapped(polycube, [](Vec3 p) {
    return Vec3{p.x + 0.1 * std::sin(3 * p.y), p.y + 0.1 * p.z * p.x, p.z};
  });
  const Lattice lattice = fit_lattice(polycube, 0);
  const TetLocator locator(lattice.tets);
  const HexMesh hexes = l_shaped_hexes(8);
  const auto many = map_back(hexes, object, lattice, locator);
  const ThreadLimit one(1);
  EXPECT_EQ(map_back(hexes, object, lattice, locator).mesh.positions, many.mesh.positions);
}

// A query beside an edge must stay on the side it asks for, and find the nearest place there.
TEST(BoundaryMap, FindsTheNearestPlaceAmongFacetsOfOneDirection) {
  const TetMesh polycube = test::tet_cubes(kL, 2);
  const Lattice lattice = fit_lattice(polycube, 0);
  const BoundaryMap boundary(lattice);
  std::mt19937_64 random(44);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = Vec3{1, 1, 0.5} + test::random_point(random, 1.5);
    for (int direction = 0; direction < 6; ++direction) {
      double nearest = std::numeric_limits<double>::infinity();
      for (TriId f : lattice.facets.ids()) {
        if (boundary.direction_of(f) != direction) continue;
        const auto& v = lattice.facets[f];
        nearest = std::min(nearest, test::brute_distance(p, {lattice.tets.positions[v[0]],
                                                             lattice.tets.positions[v[1]],
                                                             lattice.tets.positions[v[2]]}));
      }
      const auto hit = boundary.closest(p, direction);
      EXPECT_EQ(boundary.direction_of(hit.facet), direction);
      EXPECT_NEAR(distance(hit.point, p), nearest, 1e-9);
      EXPECT_NEAR(distance(boundary.carry(lattice.tets, hit), hit.point), 0, 1e-12);
    }
  }
}

/// What sampling needs, over one pair.
struct Sampled {
  TetMesh object;
  Lattice lattice;
  TetLocator locator;
  BoundaryMap boundary;
  Sampled(const TetMesh& cube, const std::function<Vec3(Vec3)>& map)
      : object(test::mapped(cube, map)),
        lattice(fit_lattice(cube, 1)),
        locator(lattice.tets),
        boundary(lattice) {}
  Grid sample(double stretch) const {
    PolycubeOptions options;
    options.max_stretch = stretch;
    options.max_surface_error = 0;
    options.max_level = 5;
    return sample_map({object, lattice, locator, boundary}, options, {});
  }
};

Vec3 swelling(Vec3 p) { return {p.x * (1 + p.x), p.y + 0.3 * p.x * p.y, p.z * (1 + 0.2 * p.y)}; }

/// Cells as (level, corner) on the lattice of level `finest`.
std::set<std::array<int, 4>> cell_set(const Grid& grid) {
  std::set<std::array<int, 4>> cells;
  for (CellId c : grid.cells.ids()) {
    const Vec3 low = cell_box(grid, c).lo * 32.0;
    cells.insert({grid.cells[c].level, int(low.x), int(low.y), int(low.z)});
  }
  return cells;
}

TEST(SampleMap, DoesNotDependOnTheObjectsUnitsAndPlace) {
  const TetMesh cube = test::tet_cubes(kL, 4);
  const auto reference = cell_set(Sampled(cube, swelling).sample(0.11));
  EXPECT_GT(reference.size(), 20u);
  for (double scale : {1e-3, 1e4}) {
    const auto moved = [&](Vec3 p) { return (swelling(p) + Vec3{5, -9, 2}) * scale; };
    EXPECT_EQ(cell_set(Sampled(cube, moved).sample(0.11)), reference) << scale;
  }
}

// The L mirrored in its diagonal, and the map with it: the cells are mirrored.
TEST(SampleMap, MirroredPairsGiveMirroredCells) {
  const TetMesh cube = test::tet_cubes(kL, 4);
  const auto swapped = [](Vec3 p) { return Vec3{p.y, p.x, p.z}; };
  const auto direct = cell_set(Sampled(cube, swelling).sample(0.11));
  const auto mirrored =
      cell_set(Sampled(cube, [&](Vec3 p) { return swelling(swapped(p)); }).sample(0.11));
  std::set<std::array<int, 4>> expected;
  for (const auto& [level, x, y, z] : direct) expected.insert({level, y, x, z});
  EXPECT_EQ(mirrored, expected);
}

// A tighter stretch only splits further: no cell becomes coarser anywhere.
TEST(SampleMap, TighterStretchesRefineTheLooserGrid) {
  const Sampled pair(test::tet_cubes(kL, 4), swelling);
  Grid looser = pair.sample(0.3);
  for (double stretch : {0.2, 0.1, 0.06}) {
    const Grid tighter = pair.sample(stretch);
    EXPECT_GT(tighter.num_cells(), looser.num_cells());
    for (CellId c : tighter.cells.ids()) {
      const CellId around = find_leaf_at(looser, cell_box(tighter, c).center());
      ASSERT_TRUE(around.is_valid());
      EXPECT_LE(looser.cells[around].level, tighter.cells[c].level);
    }
    looser = tighter;
  }
}

TEST(SampleMap, DoesNotDependOnThreads) {
  const Sampled pair(test::tet_cubes(kL, 3), swelling);
  const auto many = pair.sample(0.08).cells;
  const ThreadLimit one(1);
  EXPECT_EQ(pair.sample(0.08).cells, many);
}

TEST(RefineMisses, InwardPlacesLieInCellsOfTheDomainNextToTheirVertex) {
  std::mt19937_64 random(45);
  for (int round = 0; round < 5; ++round) {
    const Lattice lattice = fit_lattice(test::tet_cubes(grown_cubes(9, random), 2), 1);
    std::vector<CellSpec> cells;
    for (const LatticeCoord& root : lattice.roots) cells.push_back({0, root});
    const Grid grid = make_grid({}, lattice.roots, cells);
    const auto places = inward_places(lattice.tets);
    for (VertId v : places.ids()) {
      EXPECT_LT(distance(places[v], lattice.tets.positions[v]), 1e-5);
      const CellId c = find_leaf_at(grid, places[v]);
      ASSERT_TRUE(c.is_valid()) << "vertex " << v.value();
      EXPECT_TRUE(cell_box(grid, c).contains(lattice.tets.positions[v]));
    }
  }
}

// Every point marks the cell its place in the polycube lies in, and no other; points add up.
TEST(RefineMisses, MarksAreTheUnionOverThePoints) {
  const Sampled pair(test::tet_cubes(kL, 4), swelling);
  const Grid grid = pair.sample(0.2);
  const TetLocator in_object(pair.object);
  std::mt19937_64 random(46);
  std::vector<Vec3> points;
  std::vector<char> expected(grid.num_cells(), 0);
  for (int i = 0; i < 40; ++i) {
    const Vec3 q = Vec3{1, 1, 0.5} + test::random_point(random, 0.99);
    const CellId c = find_leaf_at(grid, q);
    if (!c.is_valid()) continue;
    Vec3 inside = cell_box(grid, c).center();  // away from borders, where rounding decides
    inside += (q - inside) * 0.9;
    points.push_back(interpolate(pair.object, pair.locator.locate(inside)));
    expected[c.index()] = 1;
    EXPECT_EQ(mark_cells_of_object_points(grid, points, in_object, pair.lattice, 9), expected);
  }
  EXPECT_GT(points.size(), 15u);
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(mark_cells_of_object_points(grid, points, in_object, pair.lattice, 9), expected);
}

// Vertices move along their free axes alone, at any size of the image.
TEST(Unfold, KeepsToTheFreeAxesAndFollowsScale) {
  const TetMesh cube = test::tet_cubes({{0, 0, 0}}, 3);
  for (double scale : {0.01, 1.0, 100.0}) {
    const TetMesh object = test::mapped(cube, [&](Vec3 p) { return p * scale; });
    TetMesh image = object;
    IdVector<VertId, std::uint8_t> free_axes(cube.num_verts(), 0);
    std::mt19937_64 random(47);
    for (VertId v : cube.positions.ids()) {
      const Vec3& p = cube.positions[v];
      for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] < 1e-9 || p[axis] > 1 - 1e-9) continue;
        free_axes[v] = static_cast<std::uint8_t>(free_axes[v] | 1 << axis);
        image.positions[v][axis] += scale * test::random_point(random, 0.45)[axis];
      }
    }
    const TetMesh before = image;
    const auto count_folded = [](const TetMesh& mesh) {
      std::size_t count = 0;
      for (TetId t : mesh.tets.ids()) count += !(tet_det(tet_corners(mesh, t)) > 0);
      return count;
    };
    ASSERT_GT(count_folded(before), 5u);
    EXPECT_EQ(unfold(object, free_axes, image, {}), 0u) << scale;
    EXPECT_EQ(count_folded(image), 0u) << scale;
    for (VertId v : image.positions.ids())
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_TRUE((free_axes[v] >> axis & 1) ||
                    image.positions[v][axis] == before.positions[v][axis]);
    // A map without folds is left as it is.
    TetMesh again = object;
    EXPECT_EQ(unfold(object, free_axes, again, {}), 0u);
    EXPECT_EQ(again.positions, object.positions);
  }
}

// Tets listed inside out describe the same pair; so does the object in other units.
TEST(Polycube, TheResultFollowsTheListingAndTheUnits) {
  const TetMesh cube = test::tet_cubes(kL, 2);
  const TetMesh object = test::mapped(cube, swelling);
  PolycubeOptions options;
  options.max_stretch = 0.3;
  options.max_surface_error = 0;
  const PolycubeResult reference = mesh_polycube(object, cube, options, {});
  ASSERT_GT(reference.mesh.num_hexes(), 3u);
  EXPECT_EQ(summarize_quality(reference.mesh).num_inverted, 0u);

  TetMesh turned_object = object, turned_cube = cube;
  for (TetMesh* mesh : {&turned_object, &turned_cube})
    for (auto& tet : mesh->tets) std::swap(tet[2], tet[3]);
  const PolycubeResult turned = mesh_polycube(turned_object, turned_cube, options, {});
  EXPECT_EQ(turned.mesh.hexes, reference.mesh.hexes);
  EXPECT_EQ(turned.mesh.positions, reference.mesh.positions);

  const double scale = 1024;  // a power of two: not a bit may differ
  const TetMesh large = test::mapped(object, [&](Vec3 p) { return p * scale; });
  const PolycubeResult scaled = mesh_polycube(large, cube, options, {});
  EXPECT_EQ(scaled.mesh.hexes, reference.mesh.hexes);
  double farthest = 0;
  for (VertId v : scaled.mesh.positions.ids())
    farthest =
        std::max(farthest, distance(scaled.mesh.positions[v] / scale, reference.mesh.positions[v]));
  EXPECT_LT(farthest, 1e-3);
}

}  // namespace
}  // namespace hexwright::polycube
