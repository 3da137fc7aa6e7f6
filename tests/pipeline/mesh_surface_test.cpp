// The whole pipeline on small shapes.
#include "hexwright/pipeline/mesh_surface.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/io/surface_io.h"

#include "helpers.h"
#include "pipeline/loop/loop.h"
#include "solids.h"

namespace hexwright {
namespace {

TriMesh transformed(TriMesh surface, double scale, const Vec3& shift) {
  for (Vec3& p : surface.positions) p = p * scale + shift;
  return surface;
}

TriMesh merged(TriMesh a, const TriMesh& b) {
  const auto base = static_cast<std::int32_t>(a.num_verts());
  for (const Vec3& p : b.positions) a.positions.push_back(p);
  for (const auto& t : b.tris)
    a.tris.push_back(
        {VertId(t[0].value() + base), VertId(t[1].value() + base), VertId(t[2].value() + base)});
  return a;
}

MeshOptions coarse() {
  MeshOptions options;
  options.sizing.tolerance = 0.02;
  options.sizing.max_level = 5;
  options.max_rounds = 2;
  return options;
}

void expect_valid(const MeshResult& r) {
  for (const std::string& f : r.failures) ADD_FAILURE() << f;
  EXPECT_GT(r.mesh.num_hexes(), 0u);
  EXPECT_TRUE(r.verdict.topology.is_valid());
  EXPECT_EQ(r.verdict.quality.num_inverted, 0u);
  EXPECT_FALSE(r.mesh.find_problem());
  EXPECT_FALSE(r.grid.find_problem());
}

TEST(MeshSurface, ACubeIsMetExactlyWithItsEdgesAndCorners) {
  const MeshResult r = mesh_surface(test::unit_cube_surface(), coarse(), {});
  expect_valid(r);
  ASSERT_TRUE(r.verdict.distance && r.verdict.features);
  EXPECT_LT(r.verdict.distance->max_two_way(), 1e-6);
  EXPECT_NEAR(r.verdict.features->length_share, 1, 1e-9);
  EXPECT_EQ(r.verdict.features->num_corners_recovered, 8u);
  EXPECT_NEAR(r.verdict.quality.total_volume, 1, 1e-6);
  EXPECT_NEAR(r.verdict.features->total_length, 12, 1e-9);
  const Box3 box = bounding_box(r.mesh);
  EXPECT_NEAR(distance(box.lo, {0, 0, 0}), 0, 1e-6);
  EXPECT_NEAR(distance(box.hi, {1, 1, 1}), 0, 1e-6);
}

TEST(MeshSurface, ASphereIsMetWithinTheTolerance) {
  for (double tolerance : {0.02, 0.01}) {
    MeshOptions options = coarse();
    options.sizing.tolerance = tolerance;
    const MeshResult r = mesh_surface(test::unit_sphere_surface(4), options, {});
    expect_valid(r);
    EXPECT_LE(r.verdict.distance->max_two_way(), tolerance);
    EXPECT_EQ(r.verdict.topology.genus(), 0);
    EXPECT_EQ(r.rounds.size(), static_cast<std::size_t>(r.num_rounds) + 1);
  }
}

TEST(MeshSurface, ResultsDoNotDependOnThreads) {
  const TriMesh surface = test::unit_sphere_surface(3);
  MeshOptions options = coarse();
  options.sizing.tolerance = 0.01;
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return mesh_surface(surface, options, {});
  };
  const MeshResult one = run(1), two = run(2);
  EXPECT_EQ(one.mesh.positions, two.mesh.positions);
  EXPECT_EQ(one.mesh.hexes, two.mesh.hexes);
  EXPECT_EQ(one.mesh.labels, two.mesh.labels);
  EXPECT_EQ(one.grid.cells, two.grid.cells);
}

TEST(MeshSurface, TinyHugeAndFarModelsComeOutAlike) {
  const TriMesh cube = test::unit_cube_surface();
  const std::size_t expected = mesh_surface(cube, coarse(), {}).mesh.num_hexes();
  for (double scale : {0x1p-60, 0x1p60, 1e-9, 1e9}) {
    const MeshResult r = mesh_surface(transformed(cube, scale, {}), coarse(), {});
    expect_valid(r);
    EXPECT_EQ(r.mesh.num_hexes(), expected) << "scale " << scale;
    EXPECT_NEAR(bounding_box(r.mesh).extent().x / scale, 1, 1e-6);
    EXPECT_NEAR(r.verdict.quality.total_volume / (scale * scale * scale), 1, 1e-6);
  }
  const Vec3 shift = {1e7, -3e6, 5e6};
  const MeshResult far = mesh_surface(transformed(cube, 1, shift), coarse(), {});
  expect_valid(far);
  EXPECT_EQ(far.mesh.num_hexes(), expected);
  EXPECT_NEAR(distance(bounding_box(far.mesh).lo, shift), 0, 1e-6);
}

TEST(MeshSurface, SeparatePartsStaySeparate) {
  const TriMesh two =
      merged(test::unit_cube_surface(), transformed(test::unit_cube_surface(), 1, {1.5, 0.2, 0}));
  const MeshResult r = mesh_surface(two, coarse(), {});
  expect_valid(r);
  EXPECT_EQ(r.verdict.topology.num_components, 2u);
}

TEST(MeshSurface, RefinementGoesWhereTheFitMissed) {
  MeshOptions options = coarse();
  options.sizing.tolerance = 0.006;
  options.sizing.deviation_factor = 8;  // far too coarse a start
  options.max_rounds = 6;
  options.mean_share = 0;  // the maximum alone decides
  const MeshResult r = mesh_surface(test::unit_sphere_surface(5), options, {});
  expect_valid(r);
  ASSERT_GT(r.num_rounds, 0);
  EXPECT_GT(r.rounds.front().max_distance, options.sizing.tolerance);
  EXPECT_LE(r.verdict.distance->max_two_way(), options.sizing.tolerance);
  EXPECT_DOUBLE_EQ(r.rounds[static_cast<std::size_t>(r.best_round)].max_distance,
                   r.verdict.distance->max_two_way());
  for (std::size_t k = 1; k < r.rounds.size(); ++k)
    EXPECT_GT(r.rounds[k].num_cells, r.rounds[k - 1].num_cells);
}

// All quads of a sphere err alike: no cell stands out, all of them shrink.
TEST(MeshSurface, AMeanAboveItsShareShrinksAllCells) {
  MeshOptions options = coarse();
  options.sizing.tolerance = 0.01;
  options.max_rounds = 4;
  const TriMesh sphere = test::unit_sphere_surface(5);
  options.mean_share = 0;
  const MeshResult any = mesh_surface(sphere, options, {});
  expect_valid(any);
  options.mean_share = 0.8 * any.verdict.distance->mean_two_way() / options.sizing.tolerance;
  const MeshResult close = mesh_surface(sphere, options, {});
  expect_valid(close);
  EXPECT_LE(close.verdict.distance->max_two_way(), options.sizing.tolerance);
  EXPECT_LE(close.verdict.distance->mean_two_way(), options.mean_share * options.sizing.tolerance);
  EXPECT_TRUE(std::any_of(close.rounds.begin(), close.rounds.end(),
                          [](const RoundRecord& r) { return r.scale < 1 && r.num_marked == 0; }));
  // Less than a further level would cost.
  EXPECT_LT(close.mesh.num_hexes(), 3 * any.mesh.num_hexes());
  // The finer grid lies around the same place.
  const Vec3 center = close.grid.frame.origin + 0.5 * close.grid.frame.root_size * Vec3{1, 1, 1};
  EXPECT_LT(norm(center - bounding_box(sphere).center()), 1e-9);
}

// A coarse mesh of a sphere that is within the gate, but not the tolerance: every cell on the
// surface must split at once, so the grid multiplies.
TEST(MeshSurface, ASoundSurfaceMayMultiplyItsGridToMeetTheTolerance) {
  MeshOptions options = coarse();
  options.sizing.tolerance = 0.008;
  options.sizing.deviation_factor = 8;
  const MeshResult r = mesh_surface(test::unit_sphere_surface(4), options, {});
  expect_valid(r);
  ASSERT_GT(r.rounds.size(), 1u);
  EXPECT_GT(r.rounds[0].max_distance, options.sizing.tolerance);
  EXPECT_LE(r.rounds[0].max_distance, kGateFactor * options.sizing.tolerance);
  EXPECT_GT(static_cast<double>(r.rounds[1].num_cells),
            2.5 * static_cast<double>(r.rounds[0].num_cells));
  EXPECT_LE(r.verdict.distance->max_two_way(), options.sizing.tolerance);
}

TEST(MeshSurface, RefinementFollowsCurvesMoreCloselyThanTheSurface) {
  MeshOptions options = coarse();
  options.sizing.tolerance = 0.005;
  options.max_rounds = 4;
  options.mean_share = 0;
  const TriMesh cylinder = test::cylinder_surface(0, 0.35, 0, 1, 96);
  const MeshResult close = mesh_surface(cylinder, options, {});
  options.min_feature_share = 0;  // the distance alone decides
  const MeshResult far = mesh_surface(cylinder, options, {});
  for (const MeshResult* r : {&close, &far}) {
    expect_valid(*r);
    EXPECT_LE(r->verdict.distance->max_two_way(), options.sizing.tolerance);
  }
  EXPECT_LT(far.verdict.features->length_share, 0.98);
  EXPECT_GE(close.verdict.features->length_share, 0.98);
  EXPECT_LT(far.mesh.num_hexes(), close.mesh.num_hexes());
}

/// Edges of a surface that lead on from a vertex as straight as they can.
std::vector<std::array<VertId, 2>> straight_edges(const TriMesh& surface, VertId from,
                                                  Vec3 direction, int count) {
  std::vector<std::array<VertId, 2>> edges;
  while (static_cast<int>(edges.size()) < count) {
    VertId best;
    double best_cosine = -2;
    for (const auto& tri : surface.tris)
      for (VertId v : tri) {
        if (v == from || std::find(tri.begin(), tri.end(), from) == tri.end()) continue;
        const double cosine =
            dot(normalized(surface.positions[v] - surface.positions[from]), direction);
        if (cosine > best_cosine) best = v, best_cosine = cosine;
      }
    edges.push_back({from, best});
    direction = normalized(surface.positions[best] - surface.positions[from]);
    from = best;
  }
  return edges;
}

// A line drawn on a sphere, too short for the cells that the distance needs.
TEST(MeshSurface, RefinementFindsCurvesThatHadNoPath) {
  MeshOptions options = coarse();
  options.sizing.tolerance = 0.005;
  options.max_rounds = 4;
  const TriMesh sphere = prepare_surface(test::unit_sphere_surface(5), {}).mesh;  // welded
  options.target.features.extra_edges = straight_edges(sphere, VertId(0), {0, 0, 1}, 7);
  const MeshResult found = mesh_surface(sphere, options, {});
  options.min_feature_share = 0;
  const MeshResult lost = mesh_surface(sphere, options, {});
  for (const MeshResult* r : {&found, &lost}) {
    expect_valid(*r);
    ASSERT_EQ(r->fit.num_curves, 1u);
    EXPECT_EQ(r->verdict.features->num_corners, 2u);
  }
  EXPECT_EQ(lost.fit.num_curves_mapped, 0u);
  EXPECT_EQ(lost.fit.curves[0].reason, "shorter than the mesh resolves");
  EXPECT_EQ(found.fit.num_curves_mapped, 1u);
  EXPECT_GE(found.verdict.features->length_share, 0.98);
  EXPECT_EQ(found.verdict.features->num_corners_recovered, 2u);
  EXPECT_LT(found.mesh.num_hexes(), 3 * lost.mesh.num_hexes());  // finer along the line only
}

TEST(MeshSurface, ASinglePassMakesOneRound) {
  MeshOptions options = coarse();
  use_single_pass(options);
  const MeshResult r = mesh_surface(test::unit_sphere_surface(3), options, {});
  expect_valid(r);
  EXPECT_EQ(r.num_rounds, 0);
  EXPECT_EQ(r.rounds.size(), 1u);
}

TEST(MeshSurface, ThePapersSizingAndEveryPairingGiveValidMeshes) {
  for (Pairing pairing : {Pairing::Blocks, Pairing::Octree}) {
    MeshOptions options = coarse();
    options.sizing.sizing = Sizing::Thickness;
    options.complete.pairing = pairing;
    options.max_rounds = 0;
    expect_valid(mesh_surface(test::unit_sphere_surface(3), options, {}));
  }
}

TEST(MeshSurface, AMeshTooCoarseFailsTheGateByName) {
  MeshOptions options;
  options.sizing.max_level = 2;
  options.max_rounds = 0;
  const MeshResult r = mesh_surface(test::unit_sphere_surface(4), options, {});
  EXPECT_GT(r.mesh.num_hexes(), 0u);
  ASSERT_EQ(r.failures.size(), 1u);
  EXPECT_NE(r.failures[0].find("departs from the surface"), std::string::npos) << r.failures[0];
}

TEST(MeshSurface, BudgetsCostLevelsBeforeTheyCostTheMesh) {
  MeshOptions options;
  options.sizing.min_level = 1;
  options.max_rounds = 0;
  const TriMesh surface = test::unit_sphere_surface(4);
  const std::size_t free = mesh_surface(surface, options, {}).grid.num_cells();
  options.max_hexes = free / 2;
  const MeshResult r = mesh_surface(surface, options, {});
  EXPECT_LE(r.grid.num_cells(), options.max_hexes);
  EXPECT_TRUE(std::any_of(r.warnings.begin(), r.warnings.end(), [](const std::string& w) {
    return w.find("more than the budget") != std::string::npos;
  }));
  options.max_hexes = 2;
  try {
    mesh_surface(surface, options, {});
    ADD_FAILURE() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::OutOfResources);
  }
}

template <class Run>
void expect_beyond_budget(const Run& run, const std::string& remedy) {
  try {
    run();
    ADD_FAILURE() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::OutOfResources);
    EXPECT_NE(std::string(e.what()).find(remedy), std::string::npos) << e.what();
  }
}

TEST(MeshSurface, MoreHexesNeverGiveAMeshThatIsFartherOff) {
  MeshOptions options;
  options.sizing.tolerance = 0.001;
  const TriMesh surface = test::unit_sphere_surface(4);
  double last = 1;
  std::size_t hexes = 0;
  for (const std::size_t most : {200u, 500u, 1200u, 3000u}) {
    options.most_hexes = most;
    const MeshResult r = mesh_surface(surface, options, {});
    EXPECT_LE(r.mesh.num_hexes(), most);
    EXPECT_LE(r.verdict.distance->max_two_way(), last);
    last = r.verdict.distance->max_two_way();
    hexes = r.mesh.num_hexes();
    ASSERT_GT(last, options.sizing.tolerance);
    EXPECT_TRUE(std::ranges::any_of(r.warnings, [&](const std::string& w) {
      return w.find(fmt::format("budget of {} hexes", most)) != std::string::npos &&
             w.find("raise --max-hexes") != std::string::npos;
    }));
  }
  EXPECT_GT(hexes, 1000u);  // most of what is allowed is used
}

TEST(MeshSurface, ABudgetThatIsNotUsedUpChangesNothing) {
  MeshOptions options;
  const TriMesh surface = test::unit_sphere_surface(3);
  const MeshResult free = mesh_surface(surface, options, {});
  options.most_hexes = free.mesh.num_hexes();
  const MeshResult bound = mesh_surface(surface, options, {});
  EXPECT_EQ(bound.mesh.positions.raw(), free.mesh.positions.raw());
  EXPECT_EQ(bound.warnings, free.warnings);
  options.most_hexes = 1;
  expect_beyond_budget([&] { mesh_surface(surface, options, {}); }, "raise --max-hexes");
}

// What a round too few leaves is no budget's fault.
TEST(MeshSurface, ABudgetThatLimitsNothingChangesNothingOfAMeshBeyondTheTolerance) {
  MeshOptions options = coarse();
  options.sizing.tolerance = 0.008;
  options.sizing.deviation_factor = 8;
  options.max_rounds = 0;
  const TriMesh surface = test::unit_sphere_surface(4);
  const MeshResult free = mesh_surface(surface, options, {});
  ASSERT_GT(free.verdict.distance->max_two_way(), options.sizing.tolerance);
  ASSERT_TRUE(free.failures.empty());
  options.most_hexes = 10 * free.mesh.num_hexes();
  const MeshResult bound = mesh_surface(surface, options, {});
  EXPECT_EQ(bound.mesh.positions.raw(), free.mesh.positions.raw());
  EXPECT_EQ(bound.warnings, free.warnings);
  EXPECT_FALSE(bound.is_limited);
}

TEST(MeshSurface, ABudgetIsThatOfAllBodiesTogetherWhateverSizesThem) {
  const TriMesh two = test::joined(
      {test::box_surface({0, 0, 0}, {10, 10, 4}), test::box_surface({0, 0, 4.02}, {10, 10, 8})});
  MeshOptions options;
  options.sizes.size = {1, false};
  const std::size_t hexes = mesh_surface(two, options, {}).mesh.num_hexes();
  options.most_hexes = hexes;
  EXPECT_EQ(mesh_surface(two, options, {}).mesh.num_hexes(), hexes);
  options.most_hexes = hexes - 1;
  expect_beyond_budget([&] { mesh_surface(two, options, {}); }, "ask for a larger size");
  options.sizes = {};
  options.sizes.cells = static_cast<int>(hexes);
  options.most_hexes = hexes / 2;
  expect_beyond_budget([&] { mesh_surface(two, options, {}); }, "ask for fewer cells");
}

std::vector<std::string> failures_of_distance(const MeshResult& result) {
  std::vector<std::string> found;
  for (const std::string& failure : result.failures)
    if (failure.find("departs from the surface") != std::string::npos) found.push_back(failure);
  return found;
}

TEST(MeshSurface, AMeshThatABudgetKeepsBeyondTheGateFailsThatOfTheToleranceAskedFor) {
  MeshOptions options;
  options.sizing.tolerance = 0.0005;
  options.sizing.deviation_factor = 40;
  options.max_rounds = 0;
  const TriMesh surface = test::unit_sphere_surface(4);
  options.most_hexes = 300;
  const MeshResult inside = mesh_surface(surface, options, {});
  const std::vector<std::string> failures = failures_of_distance(inside);
  ASSERT_EQ(failures.size(), 1u);
  EXPECT_NE(failures[0].find("more than the gate's 0.1%"), std::string::npos) << failures[0];
}

TEST(MeshSurface, NoGateOfDistanceHoldsForABudgetOutside) {
  MeshOptions options;
  options.sizing.tolerance = 0.001;
  options.fit.carve.side = Side::Outside;
  options.most_hexes = 3000;
  const MeshResult outside = mesh_surface(test::unit_sphere_surface(3), options, {});
  ASSERT_GT(outside.verdict.distance->max_two_way(), kGateFactor * options.sizing.tolerance);
  EXPECT_TRUE(failures_of_distance(outside).empty()) << outside.failures.front();
}

TEST(MeshSurface, StopsWhenCancelled) {
  std::atomic<bool> cancel{false};
  Context context;
  context.cancel = &cancel;
  context.on_progress = [&](std::string_view stage, double) {
    if (stage == "sizing") cancel = true;
  };
  try {
    mesh_surface(test::unit_sphere_surface(3), coarse(), context);
    ADD_FAILURE() << "not cancelled";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::Cancelled);
  }
}

TEST(MeshSurface, SurfacesThatEncloseNothingAreRefused) {
  TriMesh sheet;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}) sheet.positions.push_back(p);
  sheet.tris.push_back({VertId(0), VertId(1), VertId(2)});
  EXPECT_THROW(mesh_surface(sheet, coarse(), {}), Error);
  EXPECT_THROW(mesh_surface({}, coarse(), {}), Error);
}

// Random convex bodies: hulls are hard to write, so boxes under random linear maps.
TEST(MeshSurface, RandomParallelepipedsAreMeshedValidly) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> u(-0.4, 0.4);
  for (int trial = 0; trial < 4; ++trial) {
    const Vec3 a = {1, u(rng), u(rng)}, b = {u(rng), 1, u(rng)}, c = {u(rng), u(rng), 1};
    TriMesh body = test::unit_cube_surface();
    for (Vec3& p : body.positions) p = a * p.x + b * p.y + c * p.z;
    const MeshResult r = mesh_surface(body, coarse(), {});
    SCOPED_TRACE(trial);
    expect_valid(r);
    EXPECT_NEAR(r.verdict.quality.total_volume / det(a, b, c), 1, 0.03);
  }
}

// The domain's sides are nearer than a cell there: the layer under the boundary ends on them.
TEST(MeshSurface, OutsideInANarrowBoxIsMeshedWithoutTheSheetsThatFindNoRoom) {
  MeshOptions options;
  options.fit.carve.side = Side::Outside;
  options.max_rounds = 0;
  const TriMesh surface = read_surface(test::bundled("models/cube_minus_sphere.obj")).mesh;
  const MeshResult result = mesh_surface(surface, options, {});
  EXPECT_TRUE(result.verdict.topology.is_valid());
  EXPECT_EQ(result.verdict.quality.num_inverted, 0u);
  EXPECT_GT(result.mesh.num_hexes(), 100u);
}

}  // namespace
}  // namespace hexwright
