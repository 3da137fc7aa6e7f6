// The kernels below the surface tree: solid angles, closest points, the hierarchy's invariants, and
// the far-field expansion.
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/random_soup.h"
#include "geometry/tree/triangle_bvh.h"
#include "geometry/tree/triangle_math.h"
#include "helpers.h"

namespace hexwright {
namespace {

constexpr double kPi = std::numbers::pi;

TriMesh moved(const TriMesh& mesh, double scale, const Vec3& shift) {
  TriMesh out = mesh;
  for (Vec3& p : out.positions) p = p * scale + shift;
  return out;
}

/// The solid angle of one triangle seen from the origin.
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  HalfAngleSum sum;
  sum.add(a, b, c);
  return 2 * sum.value();
}

TEST(SolidAngle, AnOctantIsAnEighthOfTheSphere) {
  double sum = 0;
  for (double x : {-1.0, 1.0})
    for (double y : {-2.0, 2.0})
      for (double z : {-5.0, 5.0}) {
        const double angle = solid_angle({x, 0, 0}, {0, y, 0}, {0, 0, z});
        EXPECT_NEAR(std::abs(angle), kPi / 2, 1e-12);  // whatever the distances of the corners
        EXPECT_EQ(angle > 0, x * y * z > 0);
        sum += std::abs(angle);
      }
  EXPECT_NEAR(sum, 4 * kPi, 1e-12);
}

// A triangle seen from far away is area x cosine / distance squared; from within its plane nothing;
// from just in front it fills half the sphere.
TEST(SolidAngle, HasItsLimits) {
  const Vec3 a = {0, 0, 0}, b = {1, 0, 0}, c = {0, 1, 0};
  const Vec3 far = {300, 400, 1200};  // 1300 away, cosine 12 / 13
  EXPECT_NEAR(solid_angle(a - far, b - far, c - far), -0.5 * (12.0 / 13) / (1300.0 * 1300), 1e-9);
  const Vec3 beside = {3, 3, 0};
  EXPECT_EQ(solid_angle(a - beside, b - beside, c - beside), 0);
  const Vec3 front = {0.3, 0.3, 1e-9};
  EXPECT_NEAR(solid_angle(a - front, b - front, c - front), -2 * kPi, 1e-6);
}

TEST(ClosestOffset, AgreesWithProjectionAndSidesOnAnyTriangle) {
  const TriMesh soup = test::random_soup(300, 71);
  std::mt19937_64 random(72);
  for (TriId t : soup.tris.ids()) {
    const auto c = soup.corners(t);
    const auto data = TriangleData::make(c[0], c[1], c[2], unit_normal(c));
    for (int i = 0; i < 30; ++i) {
      const Vec3 p =
          i < 20 ? test::random_point(random, 2) : c[0] + test::random_point(random, 0.05);
      const Vec3 offset = closest_offset(data, p - c[0]);
      EXPECT_NEAR(distance(p, c[0] + offset), test::brute_distance(p, c), 1e-9)
          << "triangle " << t.value();
    }
  }
}

TEST(UnitNormal, NeitherTinyNorHugeTrianglesLoseIt) {
  const std::array<Vec3, 3> c = {Vec3{0, 0, 0}, Vec3{2, 1, 0}, Vec3{-1, 3, 1}};
  const Vec3 expected = unit_normal(c);
  EXPECT_NEAR(norm(expected), 1, 1e-15);
  for (int exponent : {-1000, -500, 500, 1000}) {
    std::array<Vec3, 3> scaled = c;
    for (Vec3& p : scaled) p = p * std::ldexp(1.0, exponent);
    EXPECT_NEAR(distance(unit_normal(scaled), expected), 0, 1e-15) << "2^" << exponent;
  }
  EXPECT_EQ(unit_normal({c[0], c[1], c[1]}), Vec3{});
  EXPECT_EQ(unit_normal({c[1], c[1], c[1]}), Vec3{});
}

/// Checks every child below a node; returns how many triangles hang there. `depth` counts nodes.
std::size_t check_below(const TriMesh& mesh, const TriangleBvh& bvh, int id, int depth) {
  EXPECT_LE(depth, bvh.depth);
  const BvhNode& node = bvh.nodes[static_cast<std::size_t>(id)];
  std::size_t sum = 0;
  for (int k = 0; k < 4; ++k) {
    const auto holds = [&](TriId t) {
      for (const Vec3& p : mesh.corners(t)) {
        const Vec3 q = (p - bvh.frame.center) * bvh.frame.inverse_scale;
        for (int axis = 0; axis < 3; ++axis)
          if (q[axis] < static_cast<double>(node.lo[axis][k]) ||
              q[axis] > static_cast<double>(node.hi[axis][k]))
            return false;
      }
      return true;
    };
    if (!node.is_leaf(k)) {
      EXPECT_GT(node.child[k], id);
      sum += check_below(mesh, bvh, node.child[k], depth + 1);
      continue;
    }
    EXPECT_LE(node.leaf_count(k), 4);
    for (int i = 0; i < node.leaf_count(k); ++i) {
      const auto slot = static_cast<std::size_t>(node.leaf_first(k) + i);
      EXPECT_TRUE(holds(bvh.slot_to_tri[slot])) << "triangle " << bvh.slot_to_tri[slot].value();
      ++sum;
    }
  }
  return sum;
}

void check_hierarchy(const TriMesh& mesh) {
  const TriangleBvh bvh = build_triangle_bvh(mesh);
  ASSERT_FALSE(bvh.nodes.empty());
  EXPECT_LE(bvh.depth, kMaxBvhDepth);
  EXPECT_EQ(check_below(mesh, bvh, 0, 1), mesh.num_tris());
  std::vector<char> is_seen(mesh.num_tris(), 0);
  for (TriId t : bvh.slot_to_tri) is_seen[t.index()] = 1;
  EXPECT_EQ(std::count(is_seen.begin(), is_seen.end(), 1), long(mesh.num_tris()));
}

TEST(TriangleBvh, HoldsEveryTriangleOnceInsideItsBoxes) {
  for (int count : {1, 4, 5, 17, 400}) check_hierarchy(test::random_soup(count, 73));
  check_hierarchy(moved(test::random_soup(200, 74), 1e-150, {}));
  check_hierarchy(moved(test::random_soup(200, 75), 1e150, {1e151, 0, 0}));
  EXPECT_TRUE(build_triangle_bvh({}).nodes.empty());
}

// What would drive a heuristic of areas to peel off one triangle at a time: sizes in geometric
// progression, and thousands of triangles on one place.
TEST(TriangleBvh, StaysShallowWhereTheHeuristicCannotSplit) {
  TriMesh series, heap;
  for (int i = 0; i < 1000; ++i) {
    const double at = std::ldexp(1.0, i - 500), size = at / 4;
    std::array<VertId, 3> tri, same;
    const Vec3 corners[3] = {{at, 0, 0}, {at + size, 0, 0}, {at, size, 0}};
    for (std::size_t k = 0; k < 3; ++k) {
      tri[k] = series.positions.push_back(corners[k]);
      same[k] = heap.positions.push_back(Vec3{double(k == 1), double(k == 2), 0});
    }
    series.tris.push_back(tri);
    heap.tris.push_back(same);
  }
  check_hierarchy(series);
  check_hierarchy(heap);
}

TEST(WindingNumber, ExpansionErrorsShrinkWithTheAccuracyAsked) {
  const TriMesh soup = test::random_soup(600, 76);
  const SurfaceTree tree(soup);
  std::mt19937_64 random(77);
  double last = std::numeric_limits<double>::infinity();
  for (double accuracy : {1.5, 3.0, 6.0, 1e9}) {
    double worst = 0;
    for (int i = 0; i < 100; ++i) {
      const Vec3 p = test::random_point(random, 1.5);
      worst = std::max(worst,
                       std::abs(tree.winding_number(p, accuracy) - test::brute_winding(soup, p)));
    }
    EXPECT_LT(worst, last) << accuracy;
    last = worst;
  }
  EXPECT_LT(last, 1e-12);  // no child is that far: all exact
}

// Dipole and first-order term leave an error of fourth order in radius over distance: twice as far
// away it is a sixteenth. With a wrong first-order term it would be an eighth.
TEST(WindingNumber, FarFieldConvergesWithTheFourthOrder) {
  const TriMesh soup = test::random_soup(200, 82);
  const SurfaceTree tree(soup);
  std::mt19937_64 random(83);
  double near = 0, far = 0;
  for (int i = 0; i < 60; ++i) {
    const Vec3 direction = normalized(test::random_point(random));
    const auto error = [&](double distance) {
      const Vec3 p = direction * distance;
      return std::abs(tree.winding_number(p, 1.001) - test::brute_winding(soup, p));
    };
    near += error(20);
    far += error(40);
  }
  EXPECT_GT(near / far, 13);
  EXPECT_LT(near / far, 20);
}

TEST(WindingNumber, AddsOverPartsNegatesUnderReversalAndIgnoresSimilarities) {
  const TriMesh a = test::random_soup(150, 78), b = test::random_soup(100, 79);
  TriMesh both = a, reversed = a;
  for (const Vec3& p : b.positions) both.positions.push_back(p);
  for (const auto& t : b.tris)
    both.tris.push_back({VertId(a.num_verts() + t[0].index()), VertId(a.num_verts() + t[1].index()),
                         VertId(a.num_verts() + t[2].index())});
  for (auto& t : reversed.tris) std::swap(t[0], t[2]);
  const Vec3 shift = {7, -3, 2};
  const SurfaceTree of_a(a), of_b(b), of_both(both), of_reversed(reversed),
      of_moved(moved(a, 1e-3, shift));
  std::mt19937_64 random(80);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = test::random_point(random, 2);
    const double exact = 1e9, w = of_a.winding_number(p, exact);
    EXPECT_NEAR(of_both.winding_number(p, exact), w + of_b.winding_number(p, exact), 1e-11);
    EXPECT_NEAR(of_reversed.winding_number(p, exact), -w, 1e-11);
    EXPECT_NEAR(of_moved.winding_number(p * 1e-3 + shift, exact), w, 1e-6);
  }
}

// Across a triangle the winding number drops by one from behind it to its front.
TEST(WindingNumber, DropsByOneAcrossEveryTriangle) {
  const TriMesh soup = test::random_soup(120, 81);
  const SurfaceTree tree(soup);
  int num_tested = 0;
  for (TriId t : soup.tris.ids()) {
    const auto c = soup.corners(t);
    if (norm(cross(c[1] - c[0], c[2] - c[0])) < 1e-4) continue;  // needles: the step is too long
    const Vec3 middle = (c[0] + c[1] + c[2]) / 3, step = tree.normal(t) * 1e-8;
    EXPECT_NEAR(tree.winding_number(middle - step, 1e9) - tree.winding_number(middle + step, 1e9),
                1, 1e-3);
    ++num_tested;
  }
  EXPECT_GT(num_tested, 60);
}

}  // namespace
}  // namespace hexwright
