#include <gtest/gtest.h>

#include "hexwright/geometry/patch_index.h"

#include "geometry/random_soup.h"
#include "geometry/tree/triangle_math.h"
#include "helpers.h"

namespace hexwright {
namespace {

using test::random_point;

struct BruteClosest {
  TriId tri;
  double distance = std::numeric_limits<double>::infinity();
};

template <class Accept>
BruteClosest brute_closest(const TriMesh& surface, const Vec3& p, Accept accept) {
  BruteClosest best;
  for (TriId t : surface.tris.ids()) {
    if (!accept(t)) continue;
    const double d = test::brute_distance(p, surface.corners(t));
    if (d < best.distance) best = {t, d};
  }
  return best;
}

BruteClosest brute_closest(const TriMesh& surface, const Vec3& p) {
  return brute_closest(surface, p, [](TriId) { return true; });
}

TEST(SurfaceTree, ClosestMatchesBruteForceOnSoups) {
  for (int num_tris : {1, 2, 4, 5, 17, 60, 300}) {
    const SurfaceTree tree(test::random_soup(num_tris, 7));
    std::mt19937_64 random(11);
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = random_point(random, i % 4 == 0 ? 30 : 1.2);
      const auto found = tree.closest(p);
      ASSERT_TRUE(found);
      const double expected = brute_closest(tree.surface(), p).distance;
      EXPECT_NEAR(std::sqrt(found->distance_sq), expected, 1e-9 * (1 + expected));
      EXPECT_NEAR(distance(found->point, p), expected, 1e-9 * (1 + expected));
      EXPECT_NEAR(test::brute_distance(found->point, tree.surface().corners(found->tri)), 0, 1e-9);
    }
  }
}

TEST(SurfaceTree, ClosestIsExactAtAnyScaleAndPosition) {
  TriMesh sphere = test::unit_sphere_surface(3);
  std::mt19937_64 random(5);
  for (double scale : {1e-60, 1e-20, 1.0, 1e30, 1e60})
    for (double offset : {0.0, 1e4}) {
      TriMesh moved = sphere;
      const Vec3 shift = Vec3{1, -1, 1} * (offset * scale);
      for (Vec3& p : moved.positions) p = p * scale + shift;
      const SurfaceTree tree(moved);
      for (int i = 0; i < 50; ++i) {
        const Vec3 p = random_point(random, 2) * scale + shift;
        const double expected = brute_closest(moved, p).distance;
        EXPECT_NEAR(tree.distance(p), expected, 1e-9 * scale * (1 + offset * 1e-2));
      }
    }
}

TEST(SurfaceTree, FarPointsFindTheNearestPoint) {
  const SurfaceTree tree(test::unit_cube_surface());
  for (double far : {1e3, 1e8, 1e14}) EXPECT_EQ(tree.closest({far, 0.25, 0.5})->point.x, 1) << far;
}

TEST(SurfaceTree, EquallyNearTrianglesGiveTheLowestId) {
  TriMesh twice = test::unit_cube_surface();
  const auto once = twice.tris.raw();
  for (int copy = 0; copy < 5; ++copy)
    for (const auto& tri : once) twice.tris.push_back(tri);
  const SurfaceTree tree(twice);
  std::mt19937_64 random(3);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = Vec3{.5, .5, .5} + random_point(random, 1.5);
    ClosestFilter with_hint;
    const auto plain = tree.closest(p);
    EXPECT_LT(plain->tri.index(), once.size());
    with_hint.hint = TriId(plain->tri.index() + 3 * once.size());
    EXPECT_EQ(tree.closest(p, with_hint)->tri, plain->tri);
  }
}

TEST(SurfaceTree, FiltersMatchBruteForce) {
  const SurfaceTree tree(test::random_soup(200, 9));
  IdVector<TriId, PatchId> patches;
  for (TriId t : tree.surface().tris.ids())
    patches.push_back(PatchId(tree.surface().corners(t)[0].x > 0 ? t.value() % 5 : 5));
  const PatchIndex index(tree, patches);
  std::mt19937_64 random(13);
  for (int i = 0; i < 600; ++i) {
    const Vec3 p = random_point(random, 1.2);
    ClosestFilter filter;
    filter.patches = &index;
    if (i % 2) {
      filter.normal = normalized(random_point(random));
      filter.min_cosine = i % 3 * 0.4 - 0.2;
    }
    if (i % 5 < 3) filter.patch = PatchId(i % 6);
    if (i % 7 == 0) filter.max_distance = 0.3;
    const auto expected = brute_closest(tree.surface(), p, [&](TriId t) {
      return (!filter.patch.is_valid() || patches[t] == filter.patch) &&
             dot(filter.normal, tree.normal(t)) >= filter.min_cosine;
    });
    const auto found = tree.closest(p, filter);
    ASSERT_EQ(found.has_value(), expected.distance <= filter.max_distance);
    if (found) {
      EXPECT_NEAR(std::sqrt(found->distance_sq), expected.distance, 1e-9);
      EXPECT_TRUE(!filter.patch.is_valid() || index.patch(found->tri) == filter.patch);
    }
  }
}

TEST(PatchIndex, SeveralServeOneTree) {
  const SurfaceTree tree(test::unit_cube_surface());
  IdVector<TriId, PatchId> one(tree.surface().num_tris(), PatchId(0)), own;
  for (TriId t : one.ids()) own.push_back(PatchId(t.value()));
  const PatchIndex whole(tree, one), single(tree, own);
  ClosestFilter filter;
  filter.patch = PatchId(0);
  filter.patches = &whole;
  const Vec3 p = tree.surface().positions[tree.surface().tris[TriId(11)][0]];
  EXPECT_EQ(tree.closest(p, filter)->tri, tree.closest(p)->tri);
  filter.patches = &single;
  EXPECT_EQ(tree.closest(p, filter)->tri, TriId(0));
  const PatchIndex none;
  filter.patches = &none;
  EXPECT_FALSE(tree.closest(p, filter));
  filter.patches = nullptr;
  EXPECT_FALSE(tree.closest(p, filter));
}

TEST(SurfaceTree, NothingIsFoundOnAnEmptySurface) {
  const SurfaceTree tree{TriMesh{}};
  EXPECT_FALSE(tree.closest({}));
  EXPECT_EQ(tree.winding_number({}), 0);
  EXPECT_EQ(tree.distance({}), std::numeric_limits<double>::infinity());
}

TEST(SurfaceTree, WindingNumberMatchesBruteForce) {
  for (const TriMesh& surface : {test::random_soup(400, 21), test::unit_sphere_surface(4)}) {
    const SurfaceTree tree(surface);
    std::mt19937_64 random(17);
    double worst = 0;
    for (int i = 0; i < 500; ++i) {
      const Vec3 p = random_point(random, 1.3);
      const double exact = test::brute_winding(surface, p);
      worst = std::max(worst, std::abs(tree.winding_number(p) - exact));
      EXPECT_NEAR(tree.winding_number(p, 1e9), exact, 1e-9);
    }
    EXPECT_LT(worst, 0.08);  // far from the 0.5 that decides
  }
}

TEST(SurfaceTree, InsideIsExactForAClosedSurface) {
  const SurfaceTree sphere(test::unit_sphere_surface(4));
  std::mt19937_64 random(19);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random_point(random, 1.1);
    if (std::abs(norm(p) - 1) < 0.01) continue;  // the facets lie up to 0.5% inside
    EXPECT_EQ(sphere.is_inside(p), norm(p) < 1);
  }
}

// Products of complex numbers against a sum of arc tangents, over many turns of both signs.
TEST(HalfAngleSum, MatchesASumOfArcTangentsOverManyTurns) {
  std::mt19937_64 random(41);
  for (const int bias : {-1, 0, 1}) {
    HalfAngleSum sum;
    double expected = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 a = random_point(random, 1), b = random_point(random, 1);
      Vec3 c = random_point(random, 1);
      const double volume = det(a, b, c);
      if (bias != 0 && volume * bias < 0) c = -c;  // all angles of one sign: hundreds of turns
      sum.add(a, b, c);
      const double la = norm(a), lb = norm(b), lc = norm(c);
      expected +=
          std::atan2(det(a, b, c), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    EXPECT_NEAR(sum.value(), expected, 1e-9);
    if (bias != 0) {
      EXPECT_GT(bias * expected, 100);
    }
  }
}

// Seen from the middle of a hundred copies of a sphere, every copy counts.
TEST(SurfaceTree, WindingNumbersCountManyTurns) {
  const TriMesh sphere = test::unit_sphere_surface(1);
  TriMesh many;
  for (int copy = 0; copy < 100; ++copy) {
    const auto base = static_cast<std::int32_t>(many.num_verts());
    for (const Vec3& p : sphere.positions) many.positions.push_back(p * (1 + 0.01 * copy));
    for (auto tri : sphere.tris) {
      for (VertId& v : tri) v = VertId(v.value() + base);
      many.tris.push_back(tri);
    }
  }
  const SurfaceTree tree(many);
  EXPECT_NEAR(tree.winding_number({0.01, 0.02, 0.03}, 1e6), 100, 1e-9);
  EXPECT_NEAR(tree.winding_number({3, 0.02, 0.03}, 1e6), 0, 1e-9);
}

}  // namespace
}  // namespace hexwright
