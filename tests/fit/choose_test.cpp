// Selective padding: valid, consistently marked, and cheaper than a layer everywhere.
#include "fit/sheets/choose.h"

#include "hexwright/fit/fit.h"
#include "hexwright/quality/hex_quality.h"

#include "boundary_fixtures.h"
#include "boundary_problems.h"
#include "fit/curves/curve_convexity.h"
#include "fit/sheets/failed.h"
#include "fit/sheets/groups.h"
#include "fit/sheets/pad.h"
#include "fit/sheets/pad_boundary.h"
#include "relax/passes/sweep.h"
#include "relax/state/targets.h"

namespace hexwright::fitting {
namespace {

using namespace relax;
using test::min_jacobian;
using test::problem_of;

/// Carves a grid, pads it everywhere, fits it smoothly and maps the features.
struct Scaffold {
  Scaffold(const TriMesh& s, const HexMesh& grid)
      : surface(s),
        tree(surface),
        features(extract_features(surface, {})),
        carved(extract_hexes(grid, carve(grid, tree, {}, {}).is_kept)),
        padded(carved) {
    pad_boundary(padded);
    run_schedule(padded, {tree, nullptr}, {{0, 1, 0}, geometric_weights(1, 300, 8), 2, 0.03, false},
                 {});
    attached = attach_features(padded, tree, features, {});
  }
  SelectivePadding pad() const {
    return choose_sheets(carved, padded, attached.boundary, {tree, &features}, {});
  }
  TriMesh surface;
  SurfaceTree tree;
  FeatureGraph features;
  FitState carved, padded;
  /// Hexes of the alternative: the layer everywhere, and pillows under squeezed regions.
  std::size_t num_hexes_everywhere() const {
    FitState state = padded;
    BoundaryState boundary = attached.boundary;
    pad_squeezed_quads(state, boundary, {});
    return state.mesh.num_hexes();
  }
  AttachedFeatures attached;
};

TriMesh turned_cube(double angle) {
  TriMesh cube = test::unit_cube_surface();
  test::transform(cube.positions, [&](const Vec3& p) {
    return test::rotated((p - Vec3{.5, .5, .5}) * 8, angle) + Vec3{8, 8, 8};
  });
  return cube;
}

TEST(SelectivePadding, AddsNothingToABoxInLineWithItsGrid) {
  TriMesh cube = test::unit_cube_surface();
  test::transform(cube.positions, [](const Vec3& p) { return p * 6 + Vec3{1, 1, 1}; });
  const Scaffold s(cube, test::box_hex_mesh(8, 8, 8));
  const SelectivePadding result = s.pad();
  EXPECT_EQ(problem_of(result.state, result.boundary), "");
  EXPECT_EQ(result.report.num_groups, 6u);
  EXPECT_EQ(result.report.num_needed, 0u);
  EXPECT_EQ(result.state.mesh.num_hexes(), 216u);
}

class SelectivePaddingTurned : public ::testing::TestWithParam<double> {};

TEST_P(SelectivePaddingTurned, IsValidAndSmaller) {
  const Scaffold s(turned_cube(GetParam()), test::box_hex_mesh(16, 16, 16));
  ASSERT_EQ(problem_of(s.padded, s.attached.boundary), "");
  const SelectivePadding result = s.pad();
  EXPECT_EQ(problem_of(result.state, result.boundary), "");
  EXPECT_LE(result.report.num_sheets, result.report.num_needed);
  EXPECT_GT(result.report.num_sheets, 0u);
  EXPECT_LT(result.state.mesh.num_hexes(), s.num_hexes_everywhere());
  // The curves keep their length in edges or gain some; corners stay corners.
  EXPECT_GE(result.boundary.marked_edges().size(), s.attached.boundary.marked_edges().size());
  std::size_t corners = 0;
  for (VertKind kind : result.state.kind) corners += kind == VertKind::Corner ? 1 : 0;
  EXPECT_EQ(corners, 8u);
}

INSTANTIATE_TEST_SUITE_P(Angles, SelectivePaddingTurned, ::testing::Values(0.1, 0.25, 0.4, 0.6));

TEST(SelectivePadding, UnitesRegionsAcrossConcaveCurves) {
  TriMesh surface =
      test::surface_of(test::voxels(6, [](const Vec3& p) { return p.x < 3 || p.z < 3; }));
  const auto shares = compute_convex_shares(surface, extract_features(surface, {}));
  EXPECT_EQ(std::count(shares.begin(), shares.end(), 0.0), 1);
  EXPECT_EQ(std::count(shares.begin(), shares.end(), 1.0), 17);
  test::transform(surface.positions, [](const Vec3& p) {
    return test::rotated((p - Vec3{3, 3, 3}) * 1.5, 0.3) + Vec3{8, 8, 8};
  });
  const Scaffold s(surface, test::box_hex_mesh(16, 16, 16));
  const SelectivePadding result = s.pad();
  EXPECT_EQ(problem_of(result.state, result.boundary), "");
  EXPECT_LT(result.report.num_groups, 8u);
  EXPECT_LT(result.state.mesh.num_hexes(), s.num_hexes_everywhere());
}

TEST(SelectivePadding, ServesTheOutsideToo) {
  const TriMesh cube = turned_cube(0.4);
  const Target target = wrap_target(cube);
  FitOptions options;
  options.carve.side = Side::Outside;
  std::size_t num_hexes[2];
  for (Padding padding : {Padding::Selective, Padding::Everywhere}) {
    options.padding = padding;
    const FitResult result = fit(test::box_hex_mesh(16, 16, 16), target, options, {});
    EXPECT_EQ(result.report.num_curves_mapped, 12u);
    EXPECT_GT(min_jacobian(result.mesh), 0);
    EXPECT_EQ(result.mesh.labels.corners.size(), 8u);
    num_hexes[padding == Padding::Selective ? 0 : 1] = result.mesh.num_hexes();
  }
  EXPECT_LT(num_hexes[0], num_hexes[1]);
}

TEST(SelectivePadding, HandlesTheLoopsOfACylinder) {
  const Scaffold s(test::cylinder_surface(8, 5.3, 3.1, 12.2, 64), test::box_hex_mesh(16, 16, 16));
  const SelectivePadding result = s.pad();
  EXPECT_EQ(problem_of(result.state, result.boundary), "");
  EXPECT_GT(result.report.num_sheets, 0u);
  EXPECT_LT(result.state.mesh.num_hexes(), s.num_hexes_everywhere());
}

TEST(PillowFailed, KeepsPillowsOnlyWhenTheyMend) {
  const Scaffold s(turned_cube(0.4), test::box_hex_mesh(16, 16, 16));
  FailedOptions options;
  options.low = 2;  // every vertex of a curve has failed, and none is ever mended
  options.worthwhile = 0.99;
  FitState state = s.padded;
  BoundaryState boundary = s.attached.boundary;
  const HexMesh before = state.mesh;
  const FitTarget target{s.tree, &s.features, &s.attached.patches};
  EXPECT_EQ(pad_failed_quads(state, boundary, target, options, {}).num_sheets, 0u);
  EXPECT_EQ(state.mesh.hexes, before.hexes);
  EXPECT_EQ(state.mesh.positions, before.positions);
  options.worthwhile = 100;  // whatever is left
  const SqueezedReport report = pad_failed_quads(state, boundary, target, options, {});
  EXPECT_GT(report.num_sheets, 0u);
  EXPECT_EQ(state.mesh.num_hexes(), before.num_hexes() + report.num_hexes);
  EXPECT_EQ(problem_of(state, boundary), "");
}

TEST(PillowFailed, DoesNothingWhereNothingFailed) {
  const Scaffold s(turned_cube(0.4), test::box_hex_mesh(16, 16, 16));
  FailedOptions options;
  options.low = -1;
  options.stuck = 1e9;
  FitState state = s.padded;
  BoundaryState boundary = s.attached.boundary;
  pad_failed_quads(state, boundary, {s.tree, &s.features}, options, {});
  EXPECT_EQ(state.mesh.hexes, s.padded.mesh.hexes);
  EXPECT_EQ(state.mesh.positions, s.padded.mesh.positions);
}

/// A slab that is in line with the grid but for one gentle slope of its top.
TEST(SelectivePadding, WrapsTheFewStepsOfALargeRegion) {
  TriMesh slab = test::unit_cube_surface();
  test::transform(slab.positions, [](const Vec3& p) {
    return Vec3{2 + 30 * p.x, 2 + 16 * p.y, 2 + p.z * (3.3 + 1.2 * p.x)};
  });
  const Scaffold s(slab, test::box_hex_mesh(34, 20, 9));
  const SelectivePadding result = s.pad();
  EXPECT_EQ(problem_of(result.state, result.boundary), "");
  EXPECT_EQ(result.report.num_needed, 1u);
  EXPECT_EQ(result.report.num_sheets, 0u);  // of layers
  const std::size_t num_wrapped = result.state.mesh.num_hexes() - s.carved.mesh.num_hexes();
  EXPECT_GT(num_wrapped, 0u);
  EXPECT_LT(num_wrapped, 30u * 16u / 2);
  FitOptions options;
  const FitResult fitted = fit(test::box_hex_mesh(34, 20, 9), wrap_target(slab), options, {});
  EXPECT_GT(min_jacobian(fitted.mesh), 0.3);
  for (const HexFace& face : compute_hex_neighbors(fitted.mesh).boundary)
    for (VertId v : face_verts(fitted.mesh, face))
      EXPECT_LT(s.tree.distance(fitted.mesh.positions[v]), 0.05);
}

/// Two opposite faces of a box as two sheets of one batch.
struct TwoFaces {
  explicit TwoFaces(bool one_is_held) {
    TriMesh cube = test::unit_cube_surface();
    test::transform(cube.positions, [](const Vec3& p) { return p * 6 + Vec3{1, 1, 1}; });
    const Scaffold s(cube, test::box_hex_mesh(8, 8, 8));
    state = s.carved;
    boundary = s.attached.boundary;
    features = s.features;
    for (VertId v : state->kind.ids()) {
      if (!state->is_boundary(v)) continue;
      state->kind[v] = s.padded.kind[v];
      state->curve[v] = s.padded.curve[v];
      state->feature_point[v] = s.padded.feature_point[v];
      if (one_is_held && state->mesh.positions[v] == Vec3{7, 3, 3}) state->move[v] = MoveIn::Plane;
    }
    sets.num_sheets = 2;
    sets.quad_to_sheet.assign(state->quads.size(), SheetSets::kNone);
    for (QuadId q : boundary.quad_to_region.ids()) {
      Vec3 center;
      for (VertId v : state->quads[q.index()]) center += state->mesh.positions[v] * 0.25;
      if (center.x == 1) sets.quad_to_sheet[q] = 0;
      if (center.x == 7) sets.quad_to_sheet[q] = 1;
    }
  }
  std::vector<char> insert() { return pad(*state, boundary, features, sets).is_done; }
  std::optional<FitState> state;
  BoundaryState boundary;
  FeatureGraph features;
  SheetSets sets;
};

TEST(PadQuads, InsertsSheetsTogether) {
  TwoFaces faces(false);
  EXPECT_EQ(faces.insert(), (std::vector<char>{1, 1}));
  EXPECT_EQ(faces.state->mesh.num_hexes(), 216u + 72u);
  EXPECT_EQ(problem_of(*faces.state, faces.boundary), "");
}

TEST(PadQuads, LeavesOutTheSheetThatDoesNotFit) {
  TwoFaces faces(true), alone(true);
  EXPECT_EQ(faces.insert(), (std::vector<char>{1, 0}));
  EXPECT_EQ(faces.state->mesh.num_hexes(), 216u + 36u);
  EXPECT_EQ(problem_of(*faces.state, faces.boundary), "");
  // The other sheet is as if it had been alone.
  for (int& sheet : alone.sets.quad_to_sheet)
    if (sheet == 1) sheet = SheetSets::kNone;
  alone.sets.num_sheets = 1;
  EXPECT_EQ(alone.insert(), std::vector<char>{1});
  EXPECT_EQ(alone.state->mesh.hexes, faces.state->mesh.hexes);
  EXPECT_EQ(alone.state->mesh.positions, faces.state->mesh.positions);
}

TEST(PadQuads, ChangesNothingWhenNoSheetFits) {
  TwoFaces faces(true);
  for (int& sheet : faces.sets.quad_to_sheet) sheet = sheet == 1 ? 0 : SheetSets::kNone;
  faces.sets.num_sheets = 1;
  const HexMesh before = faces.state->mesh;
  EXPECT_EQ(faces.insert(), std::vector<char>{0});
  EXPECT_EQ(faces.state->mesh.hexes, before.hexes);
  EXPECT_EQ(faces.state->mesh.positions, before.positions);
}

}  // namespace
}  // namespace hexwright::fitting
