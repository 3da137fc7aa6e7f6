#include "hexwright/quality/surface_distance.h"

#include <random>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"

#include "geometry/tree/point_tree.h"
#include "helpers.h"
#include "quality/distance/triangle_samples.h"
#include "solids.h"

namespace hexwright {
namespace {

// The unit cube as n^3 hexes, scaled about its centre.
HexMesh cube_mesh(int n, double scale) {
  HexMesh mesh = test::box_hex_mesh(n, n, n);
  const Vec3 center = {0.5, 0.5, 0.5};
  for (Vec3& p : mesh.positions) p = center + scale * (p / n - center);
  return mesh;
}

const double kDiagonal = std::sqrt(3.0);

TEST(SurfaceDistance, OfTheSameCubeIsZero) {
  const SurfaceTree surface(test::unit_cube_surface());
  const auto d = measure_distance(cube_mesh(3, 1), surface, {.spacing = 0.02});
  EXPECT_LT(d.max_two_way(), 1e-15);
  EXPECT_LT(d.mean_two_way(), 1e-15);
}

TEST(SurfaceDistance, OfALargerCubeIsKnown) {
  const SurfaceTree surface(test::unit_cube_surface());
  const double e = 0.05;  // on every side
  const auto d = measure_distance(cube_mesh(3, 1 + 2 * e), surface, {.spacing = 0.01});
  EXPECT_NEAR(d.max_to_mesh, e / kDiagonal, 1e-14);
  EXPECT_NEAR(d.mean_to_mesh, e / kDiagonal, 1e-14);
  EXPECT_NEAR(d.max_to_surface, e, 1e-14);  // the corner: e sqrt(3) / diagonal
  EXPECT_GT(d.mean_to_surface, e / kDiagonal);
  EXPECT_LT(d.mean_to_surface, 1.2 * e / kDiagonal);
  EXPECT_NEAR(distance(d.worst_on_mesh, {0.5, 0.5, 0.5}), (0.5 + e) * kDiagonal, 1e-14);
}

TEST(SurfaceDistance, OfAMeshInOtherUnitsEndsSoon) {
  // A thousand times as large: a spacing of 1% of the surface's size would take 1e11 samples.
  const SurfaceTree surface(test::unit_cube_surface());
  const auto d = measure_distance(cube_mesh(3, 1000), surface, {.spacing = 0.01});
  EXPECT_NEAR(d.max_to_surface, 499.5, 1e-9);
  EXPECT_NEAR(d.max_to_mesh, 499.5 / kDiagonal, 1e-9);
}

TEST(SurfaceDistance, SeesWhatOneDirectionMisses) {
  // The mesh is half of the surface's box: everything of it is on the surface but one face.
  HexMesh half = cube_mesh(4, 1);
  for (Vec3& p : half.positions) p.z *= 0.5;
  const SurfaceTree surface(test::unit_cube_surface());
  const auto d = measure_distance(half, surface, {.spacing = 0.01});
  EXPECT_NEAR(d.max_to_mesh, 0.5 / kDiagonal, 1e-14);
  EXPECT_NEAR(d.max_to_surface, 0.5 / kDiagonal, 1e-14);
  EXPECT_NEAR(d.worst_on_mesh.z, 0.5, 1e-14);
  EXPECT_NEAR(d.worst_on_mesh.x, 0.5, 0.02);
}

TEST(SurfaceDistance, CollectsHotSamples) {
  HexMesh mesh = cube_mesh(4, 1);
  mesh.positions[VertId(124)] += {0.2, 0.2, 0.2};  // one corner pulled out
  const SurfaceTree surface(test::unit_cube_surface());
  const double threshold = 0.02;
  const auto d = measure_distance(mesh, surface, {.spacing = 0.01, .hot_threshold = threshold});
  ASSERT_FALSE(d.hot.empty());
  for (const Vec3& p : d.hot) EXPECT_GT(std::min({p.x, p.y, p.z}), 0.5);
  EXPECT_TRUE(measure_distance(mesh, surface, {.spacing = 0.01}).hot.empty());
}

// Closest distance to a triangle by brute force over all of them, and over none of our code.
double distance_to_triangle(const Vec3& p, const std::array<Vec3, 3>& t) {
  double best_sq = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = t[(k + 1) % 3] - t[k];
    const double s = std::clamp(dot(p - t[k], edge) / norm_sq(edge), 0.0, 1.0);
    best_sq = std::min(best_sq, norm_sq(p - (t[k] + s * edge)));
  }
  const Vec3 normal = normalized(cross(t[1] - t[0], t[2] - t[0]));
  bool is_above = true;
  for (int k = 0; k < 3; ++k)
    is_above = is_above && det(t[(k + 1) % 3] - t[k], p - t[k], normal) >= 0;
  if (is_above) best_sq = std::min(best_sq, dot(p - t[0], normal) * dot(p - t[0], normal));
  return std::sqrt(best_sq);
}

TEST(SurfaceDistance, AgreesWithBruteForce) {
  const TriMesh sphere = test::unit_sphere_surface(2);
  HexMesh mesh = cube_mesh(4, 1.2);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> offset(-0.1, 0.1);
  for (Vec3& p : mesh.positions) p += Vec3{offset(random), offset(random), offset(random)};
  for (Vec3& p : mesh.positions) p -= Vec3{0.5, 0.5, 0.5};
  const SurfaceTree surface(sphere);
  const DistanceOptions options{.spacing = 0.03};
  const auto d = measure_distance(mesh, surface, options);
  const double diagonal = surface.box().diagonal();
  const auto brute_force = [&](const TriMesh& from, const TriMesh& to) {
    const TriangleSamples samples(from, options.spacing * diagonal);
    double max = 0, sum = 0, weight = 0;
    samples.visit(0, samples.size(), [&](const Vec3& p, double w) {
      double least = std::numeric_limits<double>::infinity();
      for (TriId t : to.tris.ids()) least = std::min(least, distance_to_triangle(p, to.corners(t)));
      max = std::max(max, least);
      sum += w * least;
      weight += w;
    });
    return std::array<double, 2>{max / diagonal, sum / weight / diagonal};
  };
  const auto to_mesh = brute_force(sphere, boundary_triangles(mesh));
  const auto to_surface = brute_force(boundary_triangles(mesh), sphere);
  EXPECT_NEAR(d.max_to_mesh, to_mesh[0], 1e-13);
  EXPECT_NEAR(d.mean_to_mesh, to_mesh[1], 1e-13);
  EXPECT_NEAR(d.max_to_surface, to_surface[0], 1e-13);
  EXPECT_NEAR(d.mean_to_surface, to_surface[1], 1e-13);
}

TEST(SurfaceDistance, IsTheSameForAnyNumberOfThreads) {
  const SurfaceTree surface(test::unit_sphere_surface(3));
  std::vector<SurfaceDistance> results;
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    results.push_back(measure_distance(cube_mesh(6, 1), surface, {.hot_threshold = 0.1}));
  }
  EXPECT_EQ(results[0].mean_to_mesh, results[1].mean_to_mesh);
  EXPECT_EQ(results[0].mean_to_surface, results[1].mean_to_surface);
  EXPECT_EQ(results[0].max_two_way(), results[1].max_two_way());
  EXPECT_EQ(results[0].worst_on_mesh, results[1].worst_on_mesh);
  EXPECT_EQ(results[0].hot, results[1].hot);
  EXPECT_FALSE(results[0].hot.empty());
}

TEST(SurfaceDistance, OfNoMeshIsInfinite) {
  const SurfaceTree surface(test::unit_cube_surface());
  EXPECT_TRUE(std::isinf(measure_distance(HexMesh{}, surface, {}).max_two_way()));
}

TEST(SurfaceDistance, RejectsASpacingOfZero) {
  const SurfaceTree surface(test::unit_cube_surface());
  EXPECT_THROW(measure_distance(cube_mesh(1, 1), surface, {.spacing = 0}), Error);
}

TEST(BoundaryTriangles, AreClosedAndKeepTheMeshVerticesFirst) {
  const HexMesh mesh = cube_mesh(3, 1);
  const TriMesh triangles = boundary_triangles(mesh);
  EXPECT_EQ(triangles.num_tris(), 4u * 54);
  for (VertId v : mesh.positions.ids()) EXPECT_EQ(triangles.positions[v], mesh.positions[v]);
  double volume = 0;
  for (TriId t : triangles.tris.ids()) {
    const auto p = triangles.corners(t);
    volume += det(p[0], p[1], p[2]) / 6;
  }
  EXPECT_NEAR(volume, 1, 1e-14);
}

TriMesh random_triangles(int count) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> coordinate(0, 1);
  TriMesh mesh;
  for (int i = 0; i < count; ++i) {
    const double flat = i % 3 == 0 ? 0.01 : 1;  // needles too
    for (int k = 0; k < 3; ++k)
      mesh.positions.push_back({coordinate(random), flat * coordinate(random), coordinate(random)});
    mesh.tris.push_back({VertId(3 * i), VertId(3 * i + 1), VertId(3 * i + 2)});
  }
  return mesh;
}

TEST(TriangleSamples, IntegrateLinearFunctionsExactly) {
  const TriMesh mesh = random_triangles(30);
  for (double spacing : {10.0, 0.3, 0.07}) {
    const TriangleSamples samples(mesh, spacing);
    Vec3 moment;
    double area = 0;
    samples.visit(0, samples.size(), [&](const Vec3& p, double weight) {
      area += weight;
      moment += weight * p;
    });
    for (TriId t : mesh.tris.ids()) {
      const auto p = mesh.corners(t);
      const double a = 0.5 * norm(cross(p[1] - p[0], p[2] - p[0]));
      area -= a;
      moment -= a / 3 * (p[0] + p[1] + p[2]);
    }
    EXPECT_NEAR(area, 0, 1e-12);
    EXPECT_NEAR(norm(moment), 0, 1e-12);
  }
}

TEST(TriangleSamples, LeaveNoPointFartherThanTheSpacing) {
  const TriMesh mesh = random_triangles(20);
  const double spacing = 0.1;
  const TriangleSamples samples(mesh, spacing);
  std::vector<Vec3> points;
  samples.visit(0, samples.size(), [&](const Vec3& p, double) { points.push_back(p); });
  std::mt19937 random(13);
  std::uniform_real_distribution<double> parameter(0, 1);
  for (int k = 0; k < 2000; ++k) {
    const auto p = mesh.corners(TriId(k % 20));
    double u = parameter(random), v = parameter(random);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vec3 x = p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]);
    double nearest = 1e300;
    for (const Vec3& s : points) nearest = std::min(nearest, distance(s, x));
    EXPECT_LE(nearest, spacing);
  }
}

TEST(TriangleSamples, AnyPartOfTheRangeGivesTheSameSamples) {
  const TriMesh mesh = random_triangles(7);
  const TriangleSamples samples(mesh, 0.2);
  std::vector<Vec3> whole, parts;
  samples.visit(0, samples.size(), [&](const Vec3& p, double) { whole.push_back(p); });
  for (std::size_t begin = 0; begin < samples.size(); begin += 5)
    samples.visit(begin, std::min(begin + 5, samples.size()),
                  [&](const Vec3& p, double) { parts.push_back(p); });
  EXPECT_EQ(whole.size(), samples.size());
  EXPECT_EQ(whole, parts);
}

TEST(TriangleSamples, ANeedleCostsItsLength) {
  TriMesh needle;
  needle.positions = IdVector<VertId, Vec3>{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-4, 0}};
  needle.tris.push_back({VertId(0), VertId(1), VertId(2)});
  EXPECT_LE(TriangleSamples(needle, 0.001).size(), 1002u);
}

// A cube of the same orientation hidden inside another bounds nothing.
TEST(SurfaceDistance, LeavesOutPartsInsideTheSolid) {
  TriMesh surface = test::unit_cube_surface();
  const TriMesh cube = test::unit_cube_surface();
  for (const Vec3& p : cube.positions) surface.positions.push_back(p * 0.5 + Vec3{0.2, 0.2, 0.2});
  for (const auto& t : cube.tris)
    surface.tris.push_back(
        {VertId(t[0].value() + 8), VertId(t[1].value() + 8), VertId(t[2].value() + 8)});
  const SurfaceTree tree(surface);
  const HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  DistanceOptions options;
  options.hot_threshold = 0.01;
  SurfaceDistance d = measure_distance(mesh, tree, options);
  EXPECT_NEAR(d.max_two_way(), 0, 1e-12);
  EXPECT_TRUE(d.hot.empty());
  EXPECT_NEAR(d.ignored_share, 0.2, 0.02);  // 1.5 of 7.5 units of area
  options.solid_only = false;
  d = measure_distance(mesh, tree, options);
  EXPECT_NEAR(d.max_to_mesh * std::sqrt(3.0), 0.3, 0.01);
  EXPECT_FALSE(d.hot.empty());
  EXPECT_EQ(d.ignored_share, 0);
}

// The winding number closes a plane hole by its plane.
TEST(SurfaceDistance, LeavesOutTheMeshThatClosesAHole) {
  TriMesh open = test::unit_cube_surface();
  open.tris.resize(10);  // without the side z = 1
  const SurfaceTree tree(open);
  const HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  DistanceOptions options;
  EXPECT_NEAR(measure_distance(mesh, tree, options).max_to_surface, 0, 0.005);
  options.solid_only = false;
  EXPECT_GT(measure_distance(mesh, tree, options).max_to_surface, 0.2);
}

/// The unit cells of a lattice of 10 x 10 x 10 within either of two boxes.
HexMesh cells_within(const Box3& a, const Box3& b) {
  const HexMesh all = test::box_hex_mesh(10, 10, 10);
  HexMesh mesh;
  mesh.positions = all.positions;
  for (const auto& hex : all.hexes) {
    const Vec3 center = (all.positions[hex[0]] + all.positions[hex[6]]) / 2;
    if (a.contains(center) || b.contains(center)) mesh.hexes.push_back(hex);
  }
  return mesh;
}

// Two boxes that cross, with their walls in each other, and the perfect mesh of their union: what
// lies inside is no distance, however large a part of the surface it is and however it is cut into
// chunks. A mesh that lacks a corner is as far off as it is.
TEST(SurfaceDistance, HiddenWallsChangeNoFigure) {
  const Box3 plate{{0, 0, 1}, {10, 10, 3}}, post{{3, 3, 0}, {7, 7, 10}};
  const SurfaceTree tree(
      test::joined({test::box_surface(plate.lo, plate.hi), test::box_surface(post.lo, post.hi)}));
  HexMesh mesh = cells_within(plate, post);
  for (double spacing : {0.01, 0.004, 0.0013}) {
    DistanceOptions options;
    options.spacing = spacing;
    options.hot_threshold = 0.001;
    const SurfaceDistance d = measure_distance(mesh, tree, options);
    EXPECT_LT(d.max_two_way(), 1.5e-4) << spacing;
    EXPECT_TRUE(d.hot.empty());
    EXPECT_NEAR(d.ignored_share, 64.0 / (280 + 192), 0.02);
  }
  for (VertId v : mesh.positions.ids())
    if (mesh.positions[v] == Vec3{3, 3, 10}) mesh.positions[v].z = 9;
  const double missing = measure_distance(mesh, tree, {}).max_to_mesh * tree.diagonal();
  EXPECT_GT(missing, 0.3);
  EXPECT_LT(missing, 1);
}

// A miss stays a miss: the surface bounds the solid there.
TEST(SurfaceDistance, CountsSolidThatTheMeshLacks) {
  const SurfaceTree tree(test::unit_cube_surface());
  HexMesh half = test::box_hex_mesh(1, 1, 1);
  for (Vec3& p : half.positions) p.z *= 0.5;
  const SurfaceDistance d = measure_distance(half, tree, {});
  EXPECT_NEAR(d.max_to_mesh * std::sqrt(3.0), 0.5, 1e-9);
  EXPECT_NEAR(d.max_to_surface * std::sqrt(3.0), 0.5, 0.01);
  EXPECT_EQ(d.ignored_share, 0);
}

TEST(PointTree, AgreesWithBruteForce) {
  std::mt19937 random(14);
  std::uniform_int_distribution<int> coordinate(0, 9);  // many equal coordinates
  const auto draw = [&] {
    return Vec3{double(coordinate(random)), double(coordinate(random)), double(coordinate(random))};
  };
  std::vector<Vec3> points(500);
  for (Vec3& p : points) p = draw();
  const PointTree tree(points);
  for (int k = 0; k < 200; ++k) {
    Box3 box;
    box.extend(draw());
    box.extend(draw());
    std::vector<std::size_t> expected, found;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (box.contains(points[i])) expected.push_back(i);
    tree.visit_box(box, [&](std::size_t i) { found.push_back(i); });
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace hexwright
