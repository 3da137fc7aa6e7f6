#include "polycube/lattice/lattice.h"

#include <array>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"

#include "polycube/even_lattice.h"
#include "polycube/lattice/charts.h"
#include "polycube/tet_builders.h"
#include "polycube/tets/tet_boundary.h"
#include "polycube/tets/tet_locator.h"

namespace hexwright::polycube {
namespace {

const std::vector<LatticeCoord> kL = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

double facet_area_sum(const TetMesh& mesh, Vec3& vector_sum) {
  double area = 0;
  for (const auto& f : boundary_facets(mesh)) {
    const Vec3 n = cross(mesh.positions[f[1]] - mesh.positions[f[0]],
                         mesh.positions[f[2]] - mesh.positions[f[0]]) *
                   0.5;
    area += norm(n);
    vector_sum += n;
  }
  return area;
}

TEST(TetBoundary, FacetsCloseUpAndPointOutwards) {
  const TetMesh mesh = test::tet_cubes(kL, 2);
  Vec3 sum;
  EXPECT_NEAR(facet_area_sum(mesh, sum), 14, 1e-12);
  EXPECT_NEAR(norm(sum), 0, 1e-12);
  double volume = 0;  // divergence theorem: positive only when facets face outwards
  for (const auto& f : boundary_facets(mesh))
    volume += det(mesh.positions[f[0]], mesh.positions[f[1]], mesh.positions[f[2]]) / 6;
  EXPECT_NEAR(volume, 3, 1e-12);
}

TEST(Lattice, FindsTheCubesOfAnLShape) {
  const Lattice lattice = fit_lattice(test::tet_cubes(kL, 3), 0);
  EXPECT_EQ(lattice.roots, (std::vector<LatticeCoord>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(lattice.charts.size(), 8u);
  EXPECT_NEAR(lattice.spacing, 1, 1e-12);
  EXPECT_EQ(lattice.num_unaligned, 0u);
}

TEST(Lattice, SnapsUnevenPlanesToIntegers) {
  const auto uneven = [](Vec3 p) {
    return Vec3{5 + 0.7 * p.x + (p.x > 1 ? 0.2 * (p.x - 1) : 0), -3 + 0.9 * p.y, 0.8 * p.z};
  };
  const Lattice lattice = fit_lattice(test::mapped(test::tet_cubes(kL, 2), uneven), 0.8);
  EXPECT_EQ(lattice.roots.size(), 3u);
  for (TriId f : lattice.facets.ids())
    for (VertId v : lattice.facets[f]) {
      const Chart& chart = lattice.charts[static_cast<std::size_t>(lattice.facet_to_chart[f])];
      EXPECT_EQ(lattice.tets.positions[v][chart.axis], chart.plane);
    }
}

TEST(Lattice, SmallerSpacingGivesMoreCubes) {
  EXPECT_EQ(fit_lattice(test::tet_cubes(kL, 2), 0.5).roots.size(), 24u);
}

std::size_t count_folded(const TetMesh& mesh) {
  std::size_t count = 0;
  for (TetId t : mesh.tets.ids()) count += !(tet_det(tet_corners(mesh, t)) > 0);
  return count;
}

// Distances 1, 0.02 and pi have no common measure, and the step of 0.02 is thinner than what charts
// that a deformation left apart may be from each other: none may be lost, and none refused.
TEST(Lattice, MeetsPlanesOnNoCommonLattice) {
  const auto uneven = [](Vec3 p) {
    const auto stretch = [](double x, double second) { return x > 1 ? 1 + second * (x - 1) : x; };
    return Vec3{stretch(p.x, 0.02), stretch(p.y, 3.14159265358979), p.z};
  };
  const TetMesh polycube = test::mapped(test::tet_cubes(kL, 2), uneven);
  for (double spacing : {0.0, 0.2}) {
    const Lattice lattice = fit_lattice(polycube, spacing);
    EXPECT_EQ(lattice.charts.size(), 8u);
    EXPECT_EQ(lattice.num_merged_charts, 0u);
    EXPECT_EQ(count_folded(lattice.tets), 0u);
    EXPECT_LT(lattice.max_deviation, 1e-12);
    std::array<std::set<int>, 3> planes;
    for (const Chart& chart : lattice.charts)
      planes[static_cast<std::size_t>(chart.axis)].insert(chart.plane);
    EXPECT_EQ(planes[0].size(), 3u);
    EXPECT_EQ(planes[1].size(), 3u);
    EXPECT_EQ(planes[2].size(), 2u);
  }
}

// One boundary vertex lifted off its face, by a share of the extent.
TetMesh with_bump(double share) {
  TetMesh mesh = test::tet_cubes({{0, 0, 0}}, 4);
  for (Vec3& p : mesh.positions)
    if (distance(p, {0.5, 0.5, 1}) < 1e-9) p.z += share;
  return mesh;
}

TEST(Lattice, SnapsWhatIsNearItsPlaneAndNamesTheFacetThatIsNot) {
  EXPECT_EQ(fit_lattice(with_bump(0.05), 0).roots.size(), 1u);
  try {
    fit_lattice(with_bump(0.4), 0);
    FAIL() << "a bump of 0.4 was accepted";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::BadGeometry);
    EXPECT_NE(std::string(e.what()).find("facet"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("vertices"), std::string::npos) << e.what();
  }
}

Vec3 stretch_end(Vec3 p) { return {p.x > 2 ? 2 + 8 * (p.x - 2) : p.x, p.y, p.z}; }

TEST(SuitScales, PutsCubesWhereTheObjectIsLong) {
  const TetMesh cube = test::tet_cubes({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 4);
  const TetMesh object = test::mapped(cube, stretch_end);
  const Faces faces = find_faces(cube, 0);
  PolycubeOptions options;
  options.max_stretch = 0.05;  // of 10.1
  const auto candidates = suit_scales(faces.planes, object, cube, options);
  ASSERT_GT(candidates.size(), 1u);
  const AxisScale& x = candidates.front().scales[0];
  EXPECT_NEAR(x.slope(2.5) / x.slope(1), 8, 1.5);
  EXPECT_EQ(x(0), 0);
  EXPECT_EQ(x(3), std::round(x(3)));
  for (std::size_t i = 1; i < x.to.size(); ++i) EXPECT_GT(x.to[i], x.to[i - 1]);
  // The last is even.
  const AxisScale& even = candidates.back().scales[0];
  EXPECT_NEAR(even.slope(2.5), even.slope(1), 1e-9);
  EXPECT_LT(candidates.front().cost, 0.5 * candidates.back().cost);
}

TEST(Lattice, RefusesABoundaryThatIsNotAxisAligned) {
  const auto rotated = [](Vec3 p) { return Vec3{p.x - p.y, p.x + p.y, p.z}; };
  try {
    fit_lattice(test::mapped(test::tet_cubes(kL, 2), rotated), 0);
    FAIL() << "a rotated polycube was accepted";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::BadGeometry);
    EXPECT_NE(std::string(e.what()).find("first facet"), std::string::npos) << e.what();
  }
}

TEST(TetLocator, FindsEveryPointWhereItIs) {
  const TetMesh mesh = test::mapped(test::tet_cubes(kL, 3), [](Vec3 p) {
    return Vec3{p.x + 0.1 * p.y * p.z, p.y, p.z + 0.2 * p.x * p.x};
  });
  const TetLocator locator(mesh);
  std::uint32_t seed = 7;
  const auto random = [&] { return (seed = seed * 1664525u + 1013904223u) / 4294967296.0; };
  for (int i = 0; i < 2000; ++i) {
    const TetId tet(static_cast<int>(random() * static_cast<double>(mesh.num_tets())));
    TetPoint at{tet, {random(), random(), random(), random()}, false};
    double sum = 0;
    for (double w : at.weight) sum += w;
    for (double& w : at.weight) w /= sum;
    const Vec3 p = interpolate(mesh, at);
    const TetPoint found = locator.locate(p);
    EXPECT_FALSE(found.is_bridged);
    EXPECT_NEAR(distance(interpolate(mesh, found), p), 0, 1e-12);
  }
}

TEST(TetLocator, BridgesPointsOutsideAndCountsInvertedTets) {
  TetMesh mesh = test::tet_cubes({{0, 0, 0}}, 1);
  std::swap(mesh.tets[TetId(0)][0], mesh.tets[TetId(0)][1]);
  const TetLocator locator(mesh);
  EXPECT_EQ(locator.num_nonpositive(), 1u);
  const TetPoint outside = locator.locate({0.3, 0.2, 1.5});
  EXPECT_TRUE(outside.is_bridged);
  EXPECT_NEAR(distance(interpolate(mesh, outside), {0.3, 0.2, 1}), 0, 1e-9);
}

// Corners of a face's triangles off their plane by a tenth of an edge: a good many facets lean by
// more than 20 degrees, none belongs to another face.
TEST(Charts, LeaningFacetsStayWithTheFaceTheyNearlyFace) {
  constexpr int kCuts = 10;
  TetMesh cube = test::tet_cubes({{0, 0, 0}}, kCuts);
  std::uint32_t seed = 5;
  const auto random = [&] { return (seed = seed * 1664525u + 1013904223u) / 4294967296.0 - 0.5; };
  for (Vec3& p : cube.positions)
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] < 1e-9 || p[axis] > 1 - 1e-9) p[axis] += 0.44 * random() / kCuts;
  std::size_t num_leaning = 0;
  for (const auto& f : boundary_facets(cube)) {
    const auto& p = cube.positions;
    const Vec3 n = normalized(cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]]));
    num_leaning += std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) < 0.94;
  }
  EXPECT_GT(num_leaning, 30u);  // of 1,200: more than a hundredth
  const Lattice lattice = fit_lattice(cube, 0);
  EXPECT_EQ(lattice.charts.size(), 6u);
  EXPECT_EQ(lattice.num_unaligned, 0u);
}

TEST(Lattice, MoreCubesThanAllowedAreRefused) {
  const TetMesh bar = test::tet_cubes({{0, 0, 0}, {1, 0, 0}}, 1);
  EXPECT_EQ(fit_lattice(bar, 1, 2).roots.size(), 2u);
  try {
    fit_lattice(bar, 1, 1);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::OutOfResources);
    EXPECT_NE(std::string(error.what()).find("2 lattice cubes, more than the 1 cells allowed"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace hexwright::polycube
