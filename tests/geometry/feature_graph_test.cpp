#include "hexwright/geometry/feature_graph.h"

#include <random>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"

#include "geometry/random_soup.h"
#include "helpers.h"

namespace hexwright {
namespace {

/// A prism over a regular polygon, closed; n large makes a cylinder with two circular creases.
TriMesh prism(int n, double height) {
  TriMesh m;
  for (int z = 0; z < 2; ++z)
    for (int i = 0; i < n; ++i) {
      const double a = 2 * std::numbers::pi * i / n;
      m.positions.push_back({std::cos(a), std::sin(a), z * height});
    }
  const VertId low = m.positions.push_back({0, 0, 0});
  const VertId high = m.positions.push_back({0, 0, height});
  for (int i = 0; i < n; ++i) {
    const VertId a(i), b((i + 1) % n), c(n + i), d(n + (i + 1) % n);
    m.tris.push_back({a, b, d});
    m.tris.push_back({a, d, c});
    m.tris.push_back({low, b, a});
    m.tris.push_back({high, c, d});
  }
  return m;
}

FeatureOptions creasing_at(double angle) {
  FeatureOptions options;
  options.crease_angle = angle;
  return options;
}

FeatureOptions pruning_below(double length) {
  FeatureOptions options;
  options.min_length = length;
  return options;
}

TEST(Features, CubeHasTwelveCurvesEightCornersSixPatches) {
  const TriMesh cube = test::unit_cube_surface();
  const auto features = extract_features(cube, {});
  EXPECT_EQ(features.curves.size(), 12u);
  EXPECT_EQ(features.corners.size(), 8u);
  EXPECT_DOUBLE_EQ(features.total_length(), 12);
  const auto patches = compute_patches(cube, features);
  for (TriId t : cube.tris.ids()) EXPECT_EQ(patches[t].value(), t.value() / 2);
}

// Of two cubes that overlap, the second lies with one corner deep in the first: the three edges
// there are buried whole, and with them that corner.
TEST(Features, CreasesInsideTheSolidAreLeftOutWithATree) {
  TriMesh two = test::unit_cube_surface();
  const TriMesh cube = test::unit_cube_surface();
  for (const Vec3& p : cube.positions) two.positions.push_back(p * 0.4 + Vec3{0.9, 0.3, 0.3});
  for (const auto& t : cube.tris)
    two.tris.push_back(
        {VertId(t[0].value() + 8), VertId(t[1].value() + 8), VertId(t[2].value() + 8)});
  EXPECT_EQ(extract_features(two, {}).curves.size(), 24u);
  const FeatureGraph exposed = extract_features(SurfaceTree(two), {});
  EXPECT_EQ(exposed.curves.size(), 20u);   // without the square of edges on the buried side
  EXPECT_EQ(exposed.corners.size(), 16u);  // where the other edges enter the first cube
  EXPECT_NEAR(exposed.total_length(), 12 + 8 * 0.4, 1e-12);
}

TEST(Features, AClosedSurfaceHasTheSameFeaturesWithATree) {
  const TriMesh shape = prism(24, 1e-3);  // thin: the probe must not pass through
  const auto plain = extract_features(shape, {}),
             exposed = extract_features(SurfaceTree(shape), {});
  EXPECT_EQ(exposed.corners, plain.corners);
  EXPECT_EQ(exposed.total_length(), plain.total_length());
}

TEST(Features, FlippedTrianglesDoNotChangeCreases) {
  TriMesh cube = test::unit_cube_surface();
  for (TriId t : cube.tris.ids())
    if (t.value() % 3 == 0) std::swap(cube.tris[t][0], cube.tris[t][1]);
  EXPECT_EQ(extract_features(cube, {}).curves.size(), 12u);
}

TEST(Features, CylinderHasTwoLoopsAndThreePatches) {
  const TriMesh cylinder = prism(40, 2);
  const auto features = extract_features(cylinder, {});
  ASSERT_EQ(features.curves.size(), 2u);
  EXPECT_TRUE(features.corners.empty());
  for (const auto& c : features.curves) {
    EXPECT_TRUE(c.is_closed);
    EXPECT_EQ(c.verts.size(), 41u);
    EXPECT_EQ(c.verts.front(), c.verts.back());
  }
  const auto patches = compute_patches(cylinder, features);
  EXPECT_EQ((std::max_element(patches.begin(), patches.end())->value()), 2);
  const std::vector<char> only_first{1, 0};
  const auto merged = compute_patches(cylinder, features, only_first);
  EXPECT_EQ((std::max_element(merged.begin(), merged.end())->value()), 1);
}

TEST(Features, BoundaryIsACrease) {
  TriMesh open = test::unit_cube_surface();
  open.tris.resize(10);
  EXPECT_EQ(extract_features(open, creasing_at(3)).curves.size(), 4u);
}

TEST(Features, ShortPiecesArePrunedButNotTheUsersEdges) {
  const TriMesh sphere = prism(64, 1);
  FeatureOptions options;
  options.crease_angle = 3;  // none by angle
  options.extra_edges = {{VertId(0), VertId(1)}, {VertId(1), VertId(2)}};
  options.min_length = 100;
  const auto features = extract_features(sphere, options);
  ASSERT_EQ(features.curves.size(), 1u);
  EXPECT_EQ(features.corners, (std::vector<VertId>{VertId(0), VertId(2)}));
  EXPECT_TRUE(extract_features(sphere, pruning_below(100)).empty());
  EXPECT_EQ(extract_features(sphere, pruning_below(4)).curves.size(), 2u);
}

TEST(Features, SegmentsFollowOneEdgeOrAStraightChain) {
  // A prism of 64 sides: the corners of its top are 0 to 63, so the polygon's sides are edges.
  const TriMesh surface = prism(64, 1);
  const auto at = [&](int v) { return surface.positions[VertId(v)]; };
  FeatureOptions options;
  options.crease_angle = 3;  // none by angle
  options.extra_segments = {{at(0), at(1)}, {at(2), at(1)}};
  const auto features = extract_features(surface, options);
  ASSERT_EQ(features.curves.size(), 1u);
  EXPECT_NEAR(features.total_length(), distance(at(0), at(1)) + distance(at(1), at(2)), 1e-12);
  EXPECT_EQ(features.num_unmatched_segments, 0u);

  // No edge joins vertices that are not neighbours, and none ends beside the vertices.
  options.extra_segments = {{at(0), at(5)}, {at(0), at(1) + Vec3{0, 0, 0.01}}};
  const auto none = extract_features(surface, options);
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.num_unmatched_segments, 2u);
}

TEST(Features, ASegmentMayRunOverSeveralEdgesInLine) {
  // A sheet of 4 x 1 squares whose long sides consist of four edges each.
  TriMesh sheet;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 5; ++x) sheet.positions.push_back({double(x), double(y), 0});
  for (int x = 0; x < 4; ++x) {
    sheet.tris.push_back({VertId(x), VertId(x + 1), VertId(x + 6)});
    sheet.tris.push_back({VertId(x), VertId(x + 6), VertId(x + 5)});
  }
  FeatureOptions options;
  options.crease_angle = 3;
  const double border = extract_features(sheet, options).total_length();  // open edges are creases
  EXPECT_DOUBLE_EQ(border, 10);
  options.extra_segments = {{Vec3{4, 1, 0}, Vec3{0, 1, 0}}, {Vec3{1, 0, 0}, Vec3{2, 1, 0}}};
  const auto features = extract_features(sheet, options);
  EXPECT_EQ(features.num_unmatched_segments, 0u);
  EXPECT_NEAR(features.total_length(), border + std::sqrt(2.0), 1e-12);
}

TEST(Features, AreTheSameWithCreasesFoundBefore) {
  const SurfaceTree tree(prism(40, 2));
  FeatureOptions options;
  const FeatureGraph expected = extract_features(tree, options);
  auto creases = find_creases(tree, options.crease_angle);
  std::reverse(creases.begin(), creases.end());
  const FeatureGraph features = extract_features(tree, options, creases);
  ASSERT_EQ(features.curves.size(), expected.curves.size());
  for (CurveId c : features.curves.ids())
    EXPECT_EQ(features.curves[c].verts, expected.curves[c].verts);
  EXPECT_TRUE(extract_features(tree, options, {}).empty());
}

TEST(Features, AnEdgeOutOfRangeIsRefused) {
  FeatureOptions options;
  options.extra_edges = {{VertId(0), VertId(99)}};
  EXPECT_THROW(extract_features(test::unit_cube_surface(), options), Error);
}

TEST(FeatureCurve, ClosestMatchesDenseSampling) {
  const TriMesh cylinder = prism(40, 2);
  const auto features = extract_features(cylinder, {});
  const FeatureCurve& loop = features.curves[CurveId(1)];
  std::mt19937_64 random(23);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = test::random_point(random, 3);
    const double lo = 7 * test::random_point(random).x, width = i % 2 ? 1.5 : 20;
    double expected = std::numeric_limits<double>::infinity();
    const double end = lo + std::min(width, loop.length());
    for (int k = 0; k <= 4000; ++k)
      expected = std::min(
          expected, distance(p, point_at_arc(cylinder, loop, lo + (end - lo) * k / 4000).point));
    const auto found = closest_on_curve(cylinder, loop, p, lo, lo + width);
    EXPECT_NEAR(std::sqrt(found.distance_sq), expected, 2e-3);
    EXPECT_LE(std::sqrt(found.distance_sq), expected + 1e-12);
    EXPECT_NEAR(distance(point_at_arc(cylinder, loop, found.arc).point, found.point), 0, 1e-12);
    EXPECT_NEAR(norm(found.tangent), 1, 1e-12);
  }
}

TEST(FeatureCurve, OpenCurveClampsAtItsEnds) {
  const TriMesh cube = test::unit_cube_surface();
  const auto features = extract_features(cube, {});
  const FeatureCurve& c = features.curves[CurveId(0)];  // from (0,0,0) to (1,0,0)
  EXPECT_EQ(point_at_arc(cube, c, 5).point, (Vec3{1, 0, 0}));
  EXPECT_EQ(point_at_arc(cube, c, -5).point, (Vec3{0, 0, 0}));
  EXPECT_EQ(closest_on_curve(cube, c, {0.25, 3, 4}).arc, 0.25);
  EXPECT_EQ(closest_on_curve(cube, c, {0.25, 3, 4}).distance_sq, 25);
  EXPECT_EQ(closest_on_curve(cube, c, {0.25, 3, 4}, 0.5, 0.75).arc, 0.5);
  EXPECT_EQ(closest_on_curve(cube, c, {0.25, 3, 4}, 7, 8).arc, 1);
}

}  // namespace
}  // namespace hexwright
