#include <random>

#include "hexwright/base/parallel.h"
#include "hexwright/mesh/mid_nodes.h"
#include "hexwright/quality/surface_distance.h"
#include "hexwright/quality/verdict_json.h"

#include "helpers.h"
#include "quality/distance/convex_piece.h"
#include "quality/distance/patch_facets.h"
#include "quality/distance/triangle_samples.h"
#include "solids.h"

namespace hexwright {
namespace {

/// A cube of hexes about the origin whose vertices are off their places, so that quads are twisted.
HexMesh twisted_cube(int n, double edge, double off, unsigned seed) {
  HexMesh mesh = test::box_hex_mesh(n, n, n);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(-off, off);
  for (Vec3& p : mesh.positions)
    p = (edge / n) * p - Vec3{edge / 2, edge / 2, edge / 2} +
        Vec3{offset(random), offset(random), offset(random)};
  return mesh;
}

/// Largest distances between the surface and the patches of the boundary, by so many points that
/// none is farther from one than `step`; shares of the diagonal.
struct DenseDistance {
  double to_mesh = 0, to_surface = 0, step = 0;
};

DenseDistance measure_densely(const HexMesh& mesh, const SurfaceTree& surface, int divisions) {
  const auto quads = collect_judged_quads(mesh, JudgedQuads::Boundary);
  const QuadPatches patches(mesh, quads);
  PatchFacets dense = make_facets(patches, std::vector<int>(quads.size(), divisions));
  DenseDistance result;
  for (TriId t : dense.triangles.tris.ids()) {
    const auto c = dense.triangles.corners(t);
    for (std::size_t k = 0; k < 3; ++k)
      result.step = std::max(result.step, distance(c[k], c[(k + 1) % 3]));
  }
  for (const Vec3& p : dense.triangles.positions)
    result.to_surface = std::max(result.to_surface, surface.distance(p));
  const SurfaceTree tree(std::move(dense.triangles));
  const TriangleSamples samples(surface.surface(), result.step);
  samples.visit(0, samples.size(), [&](const Vec3& p, double) {
    result.to_mesh = std::max(result.to_mesh, tree.distance(p));
  });
  for (double* d : {&result.to_mesh, &result.to_surface, &result.step}) *d /= surface.diagonal();
  return result;
}

void expect_bounds(const HexMesh& mesh, const SurfaceTree& surface, double gap, int divisions) {
  const auto d = measure_distance(mesh, surface, {.bound_gap = gap});
  ASSERT_TRUE(d.upper.has_value());
  const DenseDistance dense = measure_densely(mesh, surface, divisions);
  EXPECT_LE(d.max_to_mesh, d.upper->to_mesh);
  EXPECT_LE(d.max_to_surface, d.upper->to_surface);
  EXPECT_LE(d.upper->two_way() - d.max_two_way(), gap * (1 + 1e-9));
  // Points are never farther than the upper bound, and the lower one is no more than a step beyond
  // the farthest of them; the dense facets are themselves a little off.
  constexpr double kFacets = 1e-4;
  EXPECT_LE(dense.to_mesh, d.upper->to_mesh + kFacets);
  EXPECT_LE(dense.to_surface, d.upper->to_surface + 1e-12);
  EXPECT_LE(d.max_to_mesh, dense.to_mesh + dense.step + kFacets);
  EXPECT_LE(d.max_to_surface, dense.to_surface + dense.step);
}

TEST(DistanceBound, OfTheSameCubeIsZero) {
  const SurfaceTree surface(test::unit_cube_surface());
  HexMesh mesh = test::box_hex_mesh(3, 3, 3);
  for (Vec3& p : mesh.positions) p = p / 3;
  const auto d = measure_distance(mesh, surface, {.bound_gap = 1e-6});
  ASSERT_TRUE(d.upper.has_value());
  EXPECT_LT(d.upper->two_way(), 1e-6);
  EXPECT_LT(d.max_two_way(), 1e-12);
}

TEST(DistanceBound, IsAbsentUnlessAskedFor) {
  const SurfaceTree surface(test::unit_cube_surface());
  EXPECT_FALSE(measure_distance(test::box_hex_mesh(1, 1, 1), surface, {}).upper.has_value());
}

// A hex whose top is a hyperbolic paraboloid: z = 1 + h at two opposite corners and 1 - h at the
// others. The patch's centre is at 1; the facets of coarser judges are as much as h off elsewhere.
TEST(DistanceBound, SeesTwistedQuadsAsBilinearPatches) {
  const SurfaceTree surface(test::unit_cube_surface());
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  for (Vec3& p : mesh.positions)
    if (p.z > 0.5) p.z += p.x == p.y ? 0.2 : -0.2;
  expect_bounds(mesh, surface, 1e-4, 60);
}

TEST(DistanceBound, HoldsForTwistedMeshes) {
  const SurfaceTree surface(test::unit_sphere_surface(3));
  for (unsigned seed = 1; seed <= 2; ++seed)
    expect_bounds(twisted_cube(3, 1.3, 0.12, seed), surface, 1e-4, 24);
}

TEST(DistanceBound, HoldsForNearMeshes) {
  const SurfaceTree surface(test::unit_cube_surface());
  for (unsigned seed = 1; seed <= 2; ++seed) {
    HexMesh mesh = twisted_cube(4, 1, 0.004, seed);
    for (Vec3& p : mesh.positions) p += {0.5, 0.5, 0.5};
    expect_bounds(mesh, surface, 1e-5, 12);
  }
}

TEST(DistanceBound, HoldsForSecondOrder) {
  const SurfaceTree surface(test::unit_sphere_surface(3));
  HexMesh mesh = twisted_cube(2, 1.2, 0.05, 5);
  mesh.mid_nodes = make_straight_mid_nodes(mesh);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> offset(-0.02, 0.02);
  for (Vec3& p : mesh.mid_nodes->edges) p += Vec3{offset(random), offset(random), offset(random)};
  expect_bounds(mesh, surface, 1e-4, 20);
}

TEST(DistanceBound, IsTheSameForAnyNumberOfThreads) {
  const SurfaceTree surface(test::unit_sphere_surface(4));
  const HexMesh mesh = twisted_cube(6, 1.3, 0.05, 9);
  std::array<SurfaceDistance, 2> d;
  for (int k = 0; k < 2; ++k) {
    const ThreadLimit limit(k == 0 ? 1 : 3);
    d[static_cast<std::size_t>(k)] = measure_distance(mesh, surface, {.bound_gap = 1e-4});
  }
  EXPECT_EQ(d[0].max_two_way(), d[1].max_two_way());
  EXPECT_EQ(d[0].upper->to_mesh, d[1].upper->to_mesh);
  EXPECT_EQ(d[0].upper->to_surface, d[1].upper->to_surface);
}

// A sheet bounds no solid: none of its points counts, wherever the mesh is.
TEST(DistanceBound, IsOfNoDistanceWhereEverySampleIsExcused) {
  TriMesh sheet;
  for (const Vec3& p : {Vec3{4, 0, 0}, Vec3{5, 0, 0}, Vec3{4, 1, 0}}) sheet.positions.push_back(p);
  sheet.tris.push_back({VertId(0), VertId(1), VertId(2)});
  const SurfaceTree surface(sheet);
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  for (Vec3& p : mesh.positions) p += {1, 2, 3};
  const auto sampled = measure_distance(mesh, surface, {});
  ASSERT_DOUBLE_EQ(sampled.ignored_share, 1);
  ASSERT_EQ(sampled.max_to_mesh, 0);
  const auto d = measure_distance(mesh, surface, {.bound_gap = 1e-3});
  ASSERT_TRUE(d.upper.has_value());
  EXPECT_EQ(d.max_to_mesh, 0);
  EXPECT_TRUE(d.upper->has_excuses);
  Verdict verdict;
  verdict.distance = d;
  const std::string text = figures_to_text(verdict);
  EXPECT_NE(text.find("as far as samples tell"), std::string::npos) << text;
  EXPECT_EQ(text.find("proven: at most"), std::string::npos) << text;
}

TEST(DistanceBound, IsAbsentForFacesWithNodesOfTheirOwn) {
  const SurfaceTree surface(test::unit_cube_surface());
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  mesh.mid_nodes = make_straight_mid_nodes(mesh);
  EXPECT_TRUE(measure_distance(mesh, surface, {.bound_gap = 1e-3}).upper.has_value());
  mesh.mid_nodes->inner.resize(1);
  EXPECT_FALSE(measure_distance(mesh, surface, {.bound_gap = 1e-3}).upper.has_value());
}

TEST(ConvexPiece, PartsHaveRoomForWhateverSignsRoundingGives) {
  ConvexPiece piece({Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}});
  while (!piece.is_full()) {
    const std::size_t size = piece.verts().size();
    std::vector<double> alternate;
    for (std::size_t i = 0; i < size; ++i) alternate.push_back(i % 2 == 0 ? 1 : -1);
    for (const ConvexPiece& part : piece.split(alternate))
      EXPECT_LE(part.verts().size(), ConvexPiece::kMaxVerts);
    std::vector<double> without_first(size, 1);
    without_first[0] = -1;
    piece = piece.split(without_first)[0];
    ASSERT_EQ(piece.verts().size(), size + 1);
  }
}

TEST(PatchFacets, ErrorsBoundTheDistanceFromThePatch) {
  const HexMesh mesh = twisted_cube(2, 1, 0.15, 3);
  const auto quads = collect_judged_quads(mesh, JudgedQuads::Boundary);
  const QuadPatches patches(mesh, quads);
  for (std::size_t q = 0; q < quads.size(); ++q) {
    TriMesh coarse, fine;
    patches.append_facets(q, 1, coarse);
    patches.append_facets(q, 16, fine);
    const SurfaceTree tree(coarse);
    double farthest = 0;
    for (const Vec3& p : fine.positions) farthest = std::max(farthest, tree.distance(p));
    EXPECT_LE(farthest, patches.facet_error(q, 1) * (1 + 1e-9));
    EXPECT_GT(farthest, 0);
  }
}

TEST(PatchFacets, DistanceOfAPointIsBoundedClosely) {
  const HexMesh mesh = twisted_cube(1, 1, 0.2, 8);
  const auto quads = collect_judged_quads(mesh, JudgedQuads::Boundary);
  const QuadPatches patches(mesh, quads);
  const SurfaceTree dense(make_facets(patches, std::vector<int>(quads.size(), 100)).triangles);
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{0.1, 0.2, 0.7}, Vec3{-2, 0.3, 0.1}}) {
    const auto bounds = patches.bound_distance(p, 1e-6);
    EXPECT_LE(bounds.upper - bounds.lower, 1e-6);
    EXPECT_NEAR(bounds.lower, dense.distance(p), 2e-5);
  }
}

}  // namespace
}  // namespace hexwright
