// Pillows under squeezed quads keep the mesh valid and the marks consistent.
#include "fit/sheets/squeezed.h"

#include <random>

#include "boundary_fixtures.h"
#include "fit/sheets/failed.h"
#include "fit/sheets/pad.h"
#include "fit/sheets/pad_boundary.h"
#include "relax/passes/sweep.h"

namespace hexwright::fitting {

using namespace relax;

namespace {

double min_jacobian(const HexMesh& mesh) {
  double least = 1;
  for (HexId h : mesh.hexes.ids()) {
    const auto p = mesh.corners(h);
    for (std::size_t lv = 0; lv < 8; ++lv) {
      const auto edge = [&](std::size_t k) {
        return p[static_cast<std::size_t>(kHexCornerNeighbors[lv][k])] - p[lv];
      };
      least = std::min(least, det(edge(0), edge(1), edge(2)));
    }
  }
  return least;
}

std::string problem_of(const FitState& state, const BoundaryState& boundary) {
  if (!compute_hex_neighbors(state.mesh).non_conforming.empty()) return "not conforming";
  if (!(min_jacobian(state.mesh) > 0)) return "inverted";
  const auto problem = boundary.find_problem(state);
  return problem ? problem->message : "";
}

/// A cube turned against the grid, carved, padded and mapped: its paths run in stairs, so that
/// many quads are squeezed.
struct TurnedCube {
  explicit TurnedCube(double angle)
      : surface(make_surface(angle)),
        tree(surface),
        state(carved(tree)),
        features(extract_features(surface, {})) {
    pad_boundary(state);
    attached = attach_features(state, tree, features, {});
  }
  static HexMesh carved(const SurfaceTree& tree) {
    const HexMesh grid = test::box_hex_mesh(16, 16, 16);
    return extract_hexes(grid, carve(grid, tree, {}, {}).is_kept);
  }
  static TriMesh make_surface(double angle) {
    TriMesh cube = test::unit_cube_surface();
    test::transform(cube.positions, [&](const Vec3& p) {
      return test::rotated((p - Vec3{.5, .5, .5}) * 8, angle) + Vec3{8, 8, 8};
    });
    return cube;
  }
  TriMesh surface;
  SurfaceTree tree;
  FitState state;
  FeatureGraph features;
  AttachedFeatures attached;
};

class Pillow : public ::testing::TestWithParam<double> {};

TEST_P(Pillow, UnderWholeRegionsLeavesNoSqueezedQuad) {
  TurnedCube c(GetParam());
  ASSERT_EQ(problem_of(c.state, c.attached.boundary), "");
  const SqueezedOptions options;
  const auto count = [&] {
    return find_squeezed_quads(c.state, c.attached.boundary, options.corner_angle).size();
  };
  const std::size_t squeezed = count();
  ASSERT_GT(squeezed, 0u);
  const std::size_t before = c.state.mesh.num_hexes();
  const SqueezedReport report = pad_squeezed_quads(c.state, c.attached.boundary, options);
  EXPECT_EQ(problem_of(c.state, c.attached.boundary), "");
  EXPECT_EQ(c.state.mesh.num_hexes(), before + report.num_hexes);
  EXPECT_GT(report.num_sheets, 0u);
  if (report.num_skipped == 0) {
    EXPECT_EQ(count(), 0u);
  }
}

TEST_P(Pillow, AroundSqueezedQuadsKeepsTheMarks) {
  TurnedCube whole(GetParam()), local(GetParam());
  SqueezedOptions options;
  const SqueezedReport w = pad_squeezed_quads(whole.state, whole.attached.boundary, options);
  options.whole_regions = false;
  const SqueezedReport l = pad_squeezed_quads(local.state, local.attached.boundary, options);
  EXPECT_EQ(problem_of(local.state, local.attached.boundary), "");
  EXPECT_GT(l.num_sheets, 0u);
  if (GetParam() < 0.5) {  // turned farther, almost every quad at a curve is squeezed
    EXPECT_LT(l.num_hexes, w.num_hexes);
  }
}

TEST_P(Pillow, OnlyAtWantedVertices) {
  TurnedCube c(GetParam());
  SqueezedOptions options;
  options.whole_regions = false;
  options.is_wanted.assign(c.state.num_verts(), 0);
  FitState none = c.state;
  BoundaryState boundary = c.attached.boundary;
  EXPECT_EQ(pad_squeezed_quads(none, boundary, options).num_sheets, 0u);
  EXPECT_EQ(none.mesh.num_hexes(), c.state.mesh.num_hexes());
  const QuadId q = find_squeezed_quads(c.state, c.attached.boundary, options.corner_angle).front();
  for (VertId v : c.state.quads[q.index()]) options.is_wanted[v.index()] = 1;
  const SqueezedReport one = pad_squeezed_quads(c.state, c.attached.boundary, options);
  EXPECT_LE(one.num_sheets, 4u);
  EXPECT_EQ(problem_of(c.state, c.attached.boundary), "");
}

TEST_P(Pillow, WhereTheFitFailedKeepsTheMeshValid) {
  TurnedCube c(GetParam());
  const FitTarget target{c.tree, &c.features, &c.attached.patches};
  run_schedule(c.state, target, {{0, 1, 0}, geometric_weights(1, 300, 5), 1, 0.03, true}, {});
  const SqueezedReport report =
      pad_failed_quads(c.state, c.attached.boundary, target, {0.5, 0.02, 2}, {});
  EXPECT_GT(report.num_sheets, 0u);
  EXPECT_EQ(problem_of(c.state, c.attached.boundary), "");
  // Nothing has failed by a limit that everything meets: nothing happens.
  const std::size_t num_hexes = c.state.mesh.num_hexes();
  pad_failed_quads(c.state, c.attached.boundary, target, {0, 1e9, 2}, {});
  EXPECT_EQ(c.state.mesh.num_hexes(), num_hexes);
}

INSTANTIATE_TEST_SUITE_P(Angles, Pillow, ::testing::Values(0.2, 0.4, 0.55, 0.7));

/// Sheets under and around random patches of the boundary, curves and corners included: what cannot
/// pass is refused, what goes in leaves a consistent boundary.
TEST(BoundaryState, HasNoProblemAfterRandomPlans) {
  const TurnedCube c(0.4);
  std::mt19937 random(5);
  int num_done = 0;
  for (int trial = 0; trial < 60; ++trial) {
    FitState state = c.state;
    BoundaryState boundary = c.attached.boundary;
    for (int k = 0; k < 3; ++k) {  // a sheet meets the sheets before it
      std::vector<QuadId> patch{QuadId(random() % state.quads.size())};
      for (int ring = static_cast<int>(random() % 4); ring > 0; --ring)
        for (std::size_t i = patch.size(); i-- > 0;)
          for (VertId v : state.quads[patch[i].index()])
            for (QuadId q : boundary.graph.quads(v)) patch.push_back(q);
      SheetSets sets;
      sets.num_sheets = 1;
      sets.quad_to_sheet.assign(state.quads.size(), SheetSets::kNone);
      if (random() % 2 == 0) sets.hex_to_sheet.assign(state.mesh.num_hexes(), SheetSets::kNone);
      const bool covers_all = random() % 4 != 0;
      for (QuadId q : patch) {
        if (covers_all || boundary.quad_to_region[q] == boundary.quad_to_region[patch[0]])
          sets.quad_to_sheet[q] = 0;
        if (!sets.hex_to_sheet.empty()) sets.hex_to_sheet[state.quad_face[q.index()].hex] = 0;
      }
      num_done += pad(state, boundary, c.features, sets).is_done[0];
      ASSERT_EQ(problem_of(state, boundary), "") << trial;
    }
  }
  EXPECT_GT(num_done, 30);
  EXPECT_LT(num_done, 180);
}

TEST(BoundaryState, FindsWhatDisagreesWithTheMesh) {
  TurnedCube c(0.4);
  const BoundaryState good = c.attached.boundary;
  BoundaryState bad = good;
  bad.quad_to_region[QuadId(0)] = {};
  EXPECT_TRUE(bad.find_problem(c.state));
  bad = good;
  for (CurveId& curve : bad.edge_to_curve)
    if (curve.is_valid()) {
      curve = {};
      break;
    }
  EXPECT_TRUE(bad.find_problem(c.state));
  bad = good;
  FitState other = c.state;
  std::swap(other.quads[0], other.quads[1]);
  EXPECT_TRUE(bad.find_problem(other));
  other = c.state;
  for (VertId v : other.kind.ids())
    if (other.kind[v] == VertKind::Surface) {
      other.kind[v] = VertKind::Corner;
      break;
    }
  EXPECT_TRUE(good.find_problem(other));
  EXPECT_FALSE(good.find_problem(c.state));
}

TEST(BoundaryState, LabelsEveryQuadEdgeAndCorner) {
  TurnedCube c(0.4);
  const BoundaryLabels labels =
      make_labels(c.state, c.attached.boundary, c.tree, c.attached.patches);
  EXPECT_EQ(labels.quads.size(), c.state.quads.size());
  for (const LabeledQuad& quad : labels.quads) EXPECT_TRUE(quad.patch.is_valid());
  EXPECT_EQ(labels.corners.size(), 8u);
  std::size_t length = 0;
  for (const CurvePath& path : c.attached.mapping.curves) length += path.verts.size() - 1;
  EXPECT_EQ(labels.edges.size(), length);
}

}  // namespace
}  // namespace hexwright::fitting
