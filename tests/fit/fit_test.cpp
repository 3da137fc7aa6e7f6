#include "hexwright/fit/fit.h"

#include <gtest/gtest.h>

#include "hexwright/base/parallel.h"
#include "hexwright/quality/hex_quality.h"
#include "hexwright/quality/hex_topology.h"
#include "hexwright/quality/surface_distance.h"

#include "fit/sheets/pad_boundary.h"
#include "fit_helpers.h"
#include "relax/passes/finish.h"
#include "relax/passes/sweep.h"
#include "relax/state/targets.h"

namespace hexwright {
namespace {

using namespace fitting;
using namespace relax;

TEST(PadBoundary, AddsOneValidHexPerBoundaryQuad) {
  std::mt19937 rng(4);
  std::uniform_real_distribution<double> offset(-0.2, 0.2);
  HexMesh mesh = test::box_hex_mesh(4, 3, 3);
  for (Vec3& p : mesh.positions) p += {offset(rng), offset(rng), offset(rng)};
  FitState state(mesh);
  const std::size_t num_quads = state.quads.size();
  pad_boundary(state);
  EXPECT_EQ(state.mesh.num_hexes(), mesh.num_hexes() + num_quads);
  EXPECT_EQ(state.quads.size(), num_quads);
  EXPECT_GT(summarize_quality(state.mesh).min_scaled_jacobian, 0);
  EXPECT_TRUE(check_topology(state.mesh).is_valid());
  for (VertId v : mesh.positions.ids()) EXPECT_EQ(state.mesh.positions[v], mesh.positions[v]);
}

TEST(Targets, AreTheClosestPointsOfASphere) {
  const SurfaceTree sphere(test::welded(test::unit_sphere_surface(4)));
  const HexMesh grid = test::grid_around(sphere.box(), 0.25);
  FitState state(extract_hexes(grid, carve(grid, sphere, {}, {}).is_kept));
  update_targets(state, {sphere, nullptr}, 0);
  int boundary = 0;
  for (VertId v : state.kind.ids()) {
    if (!state.is_boundary(v)) continue;
    ++boundary;
    EXPECT_NEAR(norm(state.target[v]), 1, 0.01);
    EXPECT_NEAR(distance(state.target[v], state.mesh.positions[v]),
                sphere.distance(state.mesh.positions[v]), 1e-9);
  }
  EXPECT_GT(boundary, 100);
}

// A small way along a plane leaves the plane; farther, or with another offset or patch, it does
// not.
TEST(Targets, AreLookedForAgainWhereSomethingChanged) {
  const SurfaceTree sphere(test::welded(test::unit_sphere_surface(4)));
  const HexMesh grid = test::grid_around(sphere.box(), 0.25);
  const FitState start(extract_hexes(grid, carve(grid, sphere, {}, {}).is_kept));
  int asked = 0;
  for (VertId v : start.kind.ids()) {
    if (!start.is_boundary(v) || v.index() % 7 != 0) continue;
    ++asked;
    FitState state = start;
    const auto target_after = [&](auto&& change) {
      change();
      update_targets(state, {sphere, nullptr}, 0);
      return state.target[v];
    };
    const double h = state.size[v];
    const Vec3 tangent = normalized(cross(state.mesh.positions[v], Vec3{0.3, 0.2, 1}));
    const Vec3 first = target_after([] {});
    EXPECT_EQ(target_after([&] { state.mesh.positions[v] += 0.005 * h * tangent; }), first);
    const Vec3 second = target_after([&] { state.mesh.positions[v] += 0.2 * h * tangent; });
    EXPECT_NEAR(distance(second, state.mesh.positions[v]), sphere.distance(state.mesh.positions[v]),
                1e-9);
    EXPECT_NE(second, first);
    const Vec3 third = target_after([&] { state.offset[v] = 0.1 * h; });
    EXPECT_NEAR(distance(third, second), 0.1 * h, 1e-9);
  }
  EXPECT_GT(asked, 20);
}

TEST(Fit, ReachesASphereWithGoodElements) {
  const Target sphere = wrap_target(test::welded(test::unit_sphere_surface(5)));
  const FitResult result = fit(test::grid_around(sphere.tree.box(), 0.12), sphere, {}, {});
  const QualitySummary quality = summarize_quality(result.mesh);
  EXPECT_GT(quality.min_scaled_jacobian, 0.5);
  EXPECT_GT(quality.avg_scaled_jacobian, 0.85);
  EXPECT_TRUE(result.report.misses.empty());
  EXPECT_TRUE(result.report.unproven.empty());
  EXPECT_TRUE(check_topology(result.mesh).is_valid());
  const SurfaceDistance distance = measure_distance(result.mesh, sphere.tree, {});
  EXPECT_LT(distance.max_two_way(), 0.003);  // the sagitta of an edge of 0.12 is 0.0005 diagonals
}

TEST(Fit, HalvesTheMeanDistanceWithVerticesBesideTheSurface) {
  const Target torus = wrap_target(test::torus_surface(1, 0.4, 120, 60));
  const HexMesh grid = test::grid_around(torus.tree.box(), 0.16);
  FitOptions options;
  const SurfaceDistance balanced =
      measure_distance(fit(grid, torus, options, {}).mesh, torus.tree, {});
  options.patch_verts = PatchVerts::OnSurface;
  const HexMesh on_surface = fit(grid, torus, options, {}).mesh;
  for (const HexFace& face : compute_hex_neighbors(on_surface).boundary)
    for (VertId v : face_verts(on_surface, face))
      EXPECT_LT(torus.tree.distance(on_surface.positions[v]), 0.02 * 0.16);
  const SurfaceDistance interpolating = measure_distance(on_surface, torus.tree, {});
  EXPECT_LT(balanced.mean_two_way(), 0.5 * interpolating.mean_two_way());
  EXPECT_LT(balanced.max_two_way(), interpolating.max_two_way());
}

// The property the stage promises, over rotations and coarse grids that do not suit the shapes.
TEST(Fit, NeverInvertsOverRandomRotationsOfShapes) {
  std::mt19937 rng(31);
  const TriMesh shapes[] = {test::unit_cube_surface(), test::torus_surface(1, 0.35, 40, 20),
                            test::welded(test::unit_sphere_surface(3))};
  for (int trial = 0; trial < 9; ++trial) {
    const Target target = wrap_target(test::randomly_rotated(shapes[trial % 3], rng));
    const double h = target.tree.box().diagonal() / (9 + 4 * (trial / 3));
    const FitResult result = fit(test::grid_around(target.tree.box(), h), target, {}, {});
    ASSERT_GT(result.mesh.num_hexes(), 0u);
    EXPECT_GT(summarize_quality(result.mesh).min_scaled_jacobian, 0) << "trial " << trial;
    EXPECT_TRUE(check_topology(result.mesh).is_valid()) << "trial " << trial;
  }
}

TEST(Fit, IsTheSameForAnyNumberOfThreads) {
  const Target torus = wrap_target(test::torus_surface(1, 0.4, 60, 30));
  const HexMesh grid = test::grid_around(torus.tree.box(), 0.16);
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return fit(grid, torus, {}, {});
  };
  const FitResult one = run(1), two = run(2);
  EXPECT_EQ(one.mesh.positions, two.mesh.positions);
  EXPECT_EQ(one.mesh.hexes, two.mesh.hexes);
}

// Boundary quads of the mesh that lie in the outer planes of the background.
std::size_t count_box_quads(const HexMesh& mesh, const Box3& box) {
  std::size_t count = 0;
  for (const HexFace& face : compute_hex_neighbors(mesh).boundary) {
    const auto quad = face_verts(mesh, face);
    for (int axis = 0; axis < 3; ++axis)
      for (double plane : {box.lo[axis], box.hi[axis]}) {
        const auto lies_in = [&](VertId v) {
          return std::abs(mesh.positions[v][axis] - plane) < 1e-12 * box.diagonal();
        };
        count += std::all_of(quad.begin(), quad.end(), lies_in);
      }
  }
  return count;
}

TEST(Fit, TakesAMeshThatAlreadyStandsForTheObject) {
  const Target sphere = wrap_target(test::welded(test::unit_sphere_surface(4)));
  HexMesh cube = test::box_hex_mesh(6, 6, 6);
  for (Vec3& p : cube.positions) p = 0.28 * (p - Vec3{3, 3, 3});
  FitOptions options;
  options.do_carve = false;
  const FitResult result = fit(cube, sphere, options, {});
  EXPECT_EQ(result.mesh.num_hexes(), 216u + 6 * 36u);  // one layer under its boundary
  EXPECT_GT(summarize_quality(result.mesh).min_scaled_jacobian, 0.3);
  EXPECT_LT(measure_distance(result.mesh, sphere.tree, {}).max_two_way(), 0.02);
}

TEST(Fit, RefusesAMeshInOtherUnits) {
  const Target sphere = wrap_target(test::welded(test::unit_sphere_surface(2)));
  FitOptions options;
  options.do_carve = false;
  for (const double scale : {100.0, 0.01}) {
    HexMesh cube = test::box_hex_mesh(2, 2, 2);
    for (Vec3& p : cube.positions) p = scale * (p - Vec3{1, 1, 1});
    EXPECT_THROW(fit(cube, sphere, options, {}), Error) << scale;
  }
  HexMesh away = test::box_hex_mesh(2, 2, 2);
  for (Vec3& p : away.positions) p.x += 10;
  EXPECT_THROW(fit(away, sphere, options, {}), Error);
}

// Four of the eight hexes around a vertex in a screw: their faces there look up, down and sideways,
// and no direction sees all of them.
TEST(PadBoundary, LeavesAMeshAloneWhereNoLayerFits) {
  std::vector<char> in_screw(8, 0);
  for (std::size_t h : {0u, 1u, 3u, 7u}) in_screw[h] = 1;
  const HexMesh screw = extract_hexes(test::box_hex_mesh(2, 2, 2), in_screw);
  ASSERT_TRUE(check_topology(screw).is_valid());
  FitState state(screw);
  EXPECT_FALSE(pad_boundary(state));
  EXPECT_EQ(state.mesh.hexes, screw.hexes);
  EXPECT_EQ(state.mesh.positions, screw.positions);
}

TEST(Lift, RaisesTheLeastWithoutLeavingTheSurface) {
  const SurfaceTree torus(test::torus_surface(1, 0.4, 60, 30));
  const HexMesh grid = test::grid_around(torus.box(), 0.16);
  FitState state(extract_hexes(grid, carve(grid, torus, {}, {}).is_kept));
  ASSERT_TRUE(pad_boundary(state));
  const FitTarget target{torus, nullptr};
  run_schedule(state, target, {{0, 1, 0}, geometric_weights(1, 1e5, 10), 2, 0.03, false}, {});
  snap_to_targets(state, target, 0.2);
  const double before = summarize_quality(state.mesh).min_scaled_jacobian;
  lift_worst(state, target, {1.0, 12, 1e-4}, {});
  EXPECT_GT(summarize_quality(state.mesh).min_scaled_jacobian, before + 0.01);
  for (VertId v : state.kind.ids()) EXPECT_LT(state.residual(v), 0.02);
}

TEST(Fit, MeshesTheOutsideInAnUnchangedBox) {
  for (const TriMesh& surface :
       {test::welded(test::unit_sphere_surface(4)), test::unit_cube_surface()}) {
    const Target target = wrap_target(surface);
    const HexMesh grid = test::grid_around(target.tree.box(), target.tree.box().diagonal() / 14);
    FitOptions options;
    options.carve.side = Side::Outside;
    options.patch_verts = PatchVerts::OnSurface;  // vertices on the surface are easily checked
    const FitResult result = fit(grid, target, options, {});
    EXPECT_GT(summarize_quality(result.mesh).min_scaled_jacobian, 0.19);
    EXPECT_TRUE(check_topology(result.mesh).is_valid());
    const Box3 box = bounding_box(grid);
    EXPECT_EQ(count_box_quads(result.mesh, box), count_box_quads(grid, box));
    const Box3 after = bounding_box(result.mesh);
    EXPECT_LT(distance(after.lo, box.lo) + distance(after.hi, box.hi), 1e-12 * box.diagonal());
    for (const HexFace& face : compute_hex_neighbors(result.mesh).boundary)
      for (VertId v : face_verts(result.mesh, face)) {
        const Vec3& p = result.mesh.positions[v];
        const Vec3 to_box = min(p - box.lo, box.hi - p);
        const double gap = std::min({to_box.x, to_box.y, to_box.z});
        EXPECT_LT(std::min(std::abs(gap), target.tree.distance(p)), 2e-3 * box.diagonal());
      }
  }
}

TEST(Fit, MeshesBothSidesWithAConformingInterface) {
  const Target sphere = wrap_target(test::welded(test::unit_sphere_surface(4)));
  const HexMesh grid = test::grid_around(sphere.tree.box(), 0.25);
  FitOptions options;
  options.carve.side = Side::Both;
  options.patch_verts = PatchVerts::OnSurface;
  const HexMesh mesh = fit(grid, sphere, options, {}).mesh;
  EXPECT_TRUE(check_topology(mesh).is_valid());
  EXPECT_GT(summarize_quality(mesh).min_scaled_jacobian, 0.2);
  const HexNeighbors neighbors = compute_hex_neighbors(mesh);
  const Box3 box = bounding_box(grid);
  EXPECT_EQ(neighbors.boundary.size(), count_box_quads(mesh, box));
  double inside = 0;
  for (HexId h : mesh.hexes.ids())
    if (mesh.region[h] == 1) inside += hex_volume(mesh.corners(h));
  EXPECT_NEAR(inside, 4.18879, 0.03 * 4.18879);
  std::size_t interface_verts = 0;
  for (HexId h : mesh.hexes.ids())
    for (int lf = 0; lf < 6; ++lf) {
      const HexId other = neighbors.neighbor[h][static_cast<std::size_t>(lf)];
      if (!other.is_valid() || mesh.region[h] == mesh.region[other]) continue;
      for (VertId v : face_verts(mesh, {h, lf})) {
        EXPECT_LT(sphere.tree.distance(mesh.positions[v]), 2e-3);
        ++interface_verts;
      }
    }
  EXPECT_GT(interface_verts, 500u);
}

TEST(Fit, NamesTheInvertedHexOfABadBackground) {
  HexMesh grid = test::box_hex_mesh(3, 3, 3);
  std::swap(grid.hexes[HexId(5)][0], grid.hexes[HexId(5)][1]);
  const Target cube = wrap_target(test::unit_cube_surface());
  try {
    fit(grid, cube, {}, {});
    FAIL() << "accepted an inverted hex";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::BadArgument);
    EXPECT_EQ(e.where(), "hex 5");
  }
}

TEST(Fit, ReturnsAnEmptyMeshWhenNothingIsKept) {
  const Target cube = wrap_target(test::unit_cube_surface());
  HexMesh far = test::box_hex_mesh(2, 2, 2);
  for (Vec3& p : far.positions) p += {10, 0, 0};
  EXPECT_EQ(fit(far, cube, {}, {}).mesh.num_hexes(), 0u);
}

// The one-shot takes any units and reports in them.
TEST(Fit, WorksInAnyUnitsAndPlaces) {
  const double scale = 1024;
  const Vec3 shift = {4096, 0, -8192};
  TriMesh cube = test::unit_cube_surface();
  HexMesh grid = test::grid_around(bounding_box(cube), 0.15);
  const FitResult plain = fit(grid, cube, {}, {}, {});
  for (Vec3& p : cube.positions) p = p * scale + shift;
  for (Vec3& p : grid.positions) p = p * scale + shift;
  const FitResult far = fit(grid, cube, {}, {}, {});
  ASSERT_EQ(far.mesh.hexes, plain.mesh.hexes);
  for (VertId v : far.mesh.positions.ids())
    EXPECT_LT(distance(far.mesh.positions[v], plain.mesh.positions[v] * scale + shift), 1e-6);
  EXPECT_NEAR(far.report.curve_length, 12 * scale, 1e-6);
  EXPECT_NEAR(far.report.curve_length_mapped, plain.report.curve_length_mapped * scale, 1e-6);
  ASSERT_EQ(far.report.curves.size(), plain.report.curves.size());
  for (std::size_t i = 0; i < far.report.curves.size(); ++i)
    EXPECT_NEAR(far.report.curves[i].max_residual, plain.report.curves[i].max_residual * scale,
                1e-6);
}

TEST(Fit, MapsEveryPlaceAndLengthOfItsReport) {
  Similarity frame;
  frame.center = {10, 20, 30};
  frame.exponent = 3;
  FitReport report;
  report.curve_length = report.curve_length_mapped = 2;
  report.curves = {{CurveId(0), true, 0.5, {}}};
  report.misses = {{{1, 1, 1}, 0.25}};
  report.carve.lost = report.carve.thin = {{1, 0, 0}};
  report.to_world(frame);
  EXPECT_EQ(report.curve_length, 16);
  EXPECT_EQ(report.curve_length_mapped, 16);
  EXPECT_EQ(report.curves[0].max_residual, 4);
  EXPECT_EQ(report.misses[0].position, (Vec3{18, 28, 38}));
  EXPECT_EQ(report.misses[0].distance, 2);
  EXPECT_EQ(report.carve.lost[0], (Vec3{18, 20, 30}));
  EXPECT_EQ(report.carve.thin[0], (Vec3{18, 20, 30}));
}

TEST(Fit, StopsWhenCancelled) {
  const Target sphere = wrap_target(test::welded(test::unit_sphere_surface(3)));
  std::atomic<bool> cancel{true};
  Context context;
  context.cancel = &cancel;
  EXPECT_THROW(fit(test::grid_around(sphere.tree.box(), 0.3), sphere, {}, context), Error);
}

}  // namespace
}  // namespace hexwright
