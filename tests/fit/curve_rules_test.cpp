// The small rules around mapped curves: which are too short, which vertex a corner gets, which are
// met badly.
#include <random>

#include <gtest/gtest.h>

#include "boundary_fixtures.h"
#include "fit/curves/ban_short_curves.h"
#include "fit/curves/judge_curves.h"
#include "fit/curves/match_corners.h"

namespace hexwright::fitting {
namespace {

using namespace relax;

/// A curve of a given length between two surface vertices; a loop when they are the same.
FeatureCurve curve_between(int first, int last, double length) {
  FeatureCurve curve;
  curve.verts = {VertId(static_cast<std::size_t>(first)), VertId(static_cast<std::size_t>(last))};
  curve.arc_length = {0, length};
  curve.is_closed = first == last;
  return curve;
}

FeatureGraph graph_of(std::vector<FeatureCurve> curves) {
  FeatureGraph graph;
  for (FeatureCurve& curve : curves) {
    if (!curve.is_closed)
      for (VertId end : {curve.verts.front(), curve.verts.back()}) graph.corners.push_back(end);
    graph.curves.push_back(std::move(curve));
  }
  std::sort(graph.corners.begin(), graph.corners.end());
  graph.corners.erase(std::unique(graph.corners.begin(), graph.corners.end()), graph.corners.end());
  return graph;
}

/// Which curves are banned in a mesh of unit edges, with at least four edges per curve.
std::vector<int> banned_in_unit_mesh(const FeatureGraph& graph) {
  const test::OwnedBoundary boundary = test::boundary_of(test::box_hex_mesh(1, 1, 1));
  const IdVector<CurveId, std::vector<TubeVert>> tubes(graph.curves.size(), {{VertId(0), 0, 0}});
  IdVector<CurveId, char> is_banned(graph.curves.size(), 0);
  const auto is_short = ban_short_curves(boundary.view(), graph, tubes, 4, is_banned);
  std::vector<int> result;
  for (CurveId c : is_banned.ids()) {
    EXPECT_EQ(is_banned[c], is_short[c]);
    result.push_back(is_banned[c]);
  }
  return result;
}

using Flags = std::vector<int>;

TEST(BanShortCurves, CountsEdgesOfLoopsAndFreeCurves) {
  EXPECT_EQ(banned_in_unit_mesh(graph_of({curve_between(0, 0, 4.1), curve_between(1, 1, 3.9)})),
            (Flags{0, 1}));
  EXPECT_EQ(banned_in_unit_mesh(graph_of({curve_between(0, 1, 4.1), curve_between(2, 3, 3.9)})),
            (Flags{0, 1}));
}

TEST(BanShortCurves, CountsConnectedCurvesTogether) {
  // A triangle of three short curves is a piece of six edges; no end is free.
  EXPECT_EQ(banned_in_unit_mesh(
                graph_of({curve_between(0, 1, 2), curve_between(1, 2, 2), curve_between(2, 0, 2)})),
            (Flags{0, 0, 0}));
  EXPECT_EQ(banned_in_unit_mesh(
                graph_of({curve_between(0, 1, 1), curve_between(1, 2, 1), curve_between(2, 0, 1)})),
            (Flags{1, 1, 1}));
}

TEST(BanShortCurves, PrunesFreeEndsRoundByRound) {
  // A short whisker on a triangle goes; the triangle stays.
  EXPECT_EQ(banned_in_unit_mesh(graph_of({curve_between(0, 1, 5), curve_between(1, 2, 5),
                                          curve_between(2, 0, 5), curve_between(2, 3, 3)})),
            (Flags{0, 0, 0, 1}));
  // Behind it another one: its end is free when the first is gone.
  EXPECT_EQ(banned_in_unit_mesh(
                graph_of({curve_between(0, 1, 5), curve_between(1, 2, 5), curve_between(2, 0, 5),
                          curve_between(2, 3, 3), curve_between(3, 4, 3)})),
            (Flags{0, 0, 0, 1, 1}));
}

TEST(BanShortCurves, MeasuresInTheEdgesAround) {
  const test::OwnedBoundary boundary = test::boundary_of(test::box_hex_mesh(1, 1, 1));
  const std::vector<TubeVert> tube = {{VertId(0), 0, 0}, {VertId(1), 0, 0}};
  EXPECT_DOUBLE_EQ(mean_edge_length(boundary.view(), tube), 1);
  EXPECT_EQ(mean_edge_length(boundary.view(), {}), 0);
}

// Against a scan over all vertices, corner by corner in order of degree.
TEST(MatchCorners, AgreesWithAScanOverAllVertices) {
  const test::OwnedBoundary boundary = test::boundary_of(test::box_hex_mesh(4, 3, 2));
  const BoundaryQuads quads = boundary.view();
  const BoundaryGraph graph(boundary.positions.size(), quads.quads);
  const double reach = 2.5;
  const VertReach tree(quads, graph.verts(), reach);
  std::mt19937 rng(4);
  std::uniform_real_distribution<double> x(-1, 5);
  for (int trial = 0; trial < 20; ++trial) {
    TriMesh surface;
    std::vector<FeatureCurve> curves;
    for (int i = 0; i < 8; ++i) surface.positions.push_back({x(rng), x(rng), x(rng)});
    for (int i = 0; i < 8; ++i)
      curves.push_back(curve_between(i, static_cast<int>((i + 1 + rng() % 7) % 8), 1));
    const FeatureGraph features = graph_of(curves);
    const CornerEnds ends = find_corner_ends(features, {});
    const auto got = match_corners(quads, graph, tree, surface, features, ends,
                                   std::vector<double>(features.corners.size(), reach));
    std::vector<char> is_taken(graph.num_verts(), 0);
    for (int degree = 16; degree > 0; --degree)
      for (std::size_t corner = 0; corner < features.corners.size(); ++corner) {
        if (ends.degree[corner] != degree) continue;
        const Vec3& p = surface.positions[features.corners[corner]];
        VertId best;
        double least = 1e300;
        for (VertId v : graph.verts()) {
          if (is_taken[v.index()] || distance(boundary.positions[v], p) > reach) continue;
          const double cost = corner_cost(quads, graph, v, p, degree);
          if (cost < least) best = v, least = cost;
        }
        EXPECT_EQ(got[corner], best);
        if (best.is_valid()) is_taken[best.index()] = 1;
      }
  }
}

TEST(MatchCorners, LeavesOutCornersOfBannedCurves) {
  const FeatureGraph features = graph_of({curve_between(0, 1, 1), curve_between(1, 2, 1)});
  IdVector<CurveId, char> is_banned(2, 0);
  is_banned[CurveId(1)] = 1;
  const CornerEnds ends = find_corner_ends(features, is_banned);
  EXPECT_EQ(ends.degree, (std::vector<int>{1, 1, 0}));
  EXPECT_EQ(ends.curve_to_corners[CurveId(1)], (std::array<int, 2>{1, 2}));
}

/// Two curves that meet in a corner; a block's vertices 0, 1 and 2 on the first, the corner, and on
/// the second. Residuals are distances, since all sizes are 1.
struct Judged {
  FitState state{test::box_hex_mesh(2, 2, 2)};
  FeatureGraph features = graph_of({curve_between(0, 1, 3), curve_between(1, 2, 2)});
  FeatureMapping mapping;

  Judged() {
    for (VertId v : state.kind.ids()) state.target[v] = state.mesh.positions[v];
    state.kind[VertId(0)] = VertKind::Curve;
    state.curve[VertId(0)] = CurveId(0);
    state.kind[VertId(1)] = VertKind::Corner;
    state.feature_point[VertId(1)] = VertId(1);
    state.kind[VertId(2)] = VertKind::Curve;
    state.curve[VertId(2)] = CurveId(1);
    mapping.curves.resize(2);
    for (CurvePath& path : mapping.curves) path.verts = {VertId(0)};
  }
  void push(std::size_t v, double way) { state.target[VertId(v)] += {0, 0, way}; }
  CurveVerdicts judge() const { return judge_curves(state, features, mapping, 0.5); }
};

TEST(JudgeCurves, FindsCurvesThatAreMetBadly) {
  Judged judged;
  EXPECT_EQ(judged.judge().num_bad, 0u);
  EXPECT_EQ(judged.judge().bad_length, 0);
  judged.push(0, 0.4);
  EXPECT_EQ(judged.judge().num_bad, 0u);
  judged.push(0, 0.2);
  const CurveVerdicts verdicts = judged.judge();
  EXPECT_EQ(verdicts.num_bad, 1u);
  EXPECT_TRUE(verdicts.is_bad[CurveId(0)]);
  EXPECT_NEAR(verdicts.residual[CurveId(0)], 0.6, 1e-12);
  EXPECT_EQ(verdicts.bad_length, 3);
}

TEST(JudgeCurves, CountsACornerAgainstTheShortestCurveAndUnmappedLength) {
  Judged judged;
  judged.push(1, 0.7);
  EXPECT_TRUE(judged.judge().is_bad[CurveId(1)]);
  EXPECT_FALSE(judged.judge().is_bad[CurveId(0)]);
  judged.mapping.curves[CurveId(1)].verts.clear();
  EXPECT_TRUE(judged.judge().is_bad[CurveId(0)]);
  EXPECT_EQ(judged.judge().bad_length, 5);
}

}  // namespace
}  // namespace hexwright::fitting
