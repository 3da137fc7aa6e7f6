// Rays against brute force, the spread of a cone of rays, and shape diameters known in closed form.
#include "geometry/walls/ray_scene.h"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "hexwright/base/parallel.h"
#include "hexwright/geometry/shape_diameter.h"

#include "geometry/random_soup.h"
#include "solids.h"

namespace hexwright {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Moeller and Trumbore's test in doubles: length to the hit, infinity when there is none.
/// `is_clear` turns false when the ray passes so near an edge that floats may decide otherwise.
double brute_hit(const std::array<Vec3, 3>& c, const Vec3& from, const Vec3& dir, bool& is_clear) {
  const Vec3 e1 = c[1] - c[0], e2 = c[2] - c[0], h = cross(dir, e2);
  const double a = dot(e1, h);
  if (std::abs(a) < 1e-6 * norm(e1) * norm(e2)) {
    is_clear = is_clear && std::abs(dot(normalized(cross(e1, e2)), from - c[0])) > 1e-3;
    return kInfinity;
  }
  const Vec3 s = from - c[0], q = cross(s, e1);
  const double u = dot(s, h) / a, v = dot(dir, q) / a, t = dot(e2, q) / a;
  constexpr double kNearEdge = 1e-3;
  if (t > -1e-3 && std::min({u, v, 1 - u - v}) > -kNearEdge &&
      std::min({u, v, 1 - u - v}) < kNearEdge)
    is_clear = false;
  if (std::abs(t) < 1e-3 && std::min({u, v, 1 - u - v}) > -kNearEdge) is_clear = false;
  return u >= 0 && v >= 0 && u + v <= 1 && t > 0 ? t : kInfinity;
}

TEST(FirstWall, IsTheNearestOfAllTriangles) {
  std::mt19937_64 random(51);
  TriMesh soup;
  for (int t = 0; t < 300; ++t) {
    const Vec3 at = test::random_point(random);
    std::array<VertId, 3> tri;
    for (VertId& v : tri) v = soup.positions.push_back(at + test::random_point(random, 0.3));
    soup.tris.push_back(tri);
  }
  const Similarity frame = compute_unit_frame(soup);
  const SurfaceTree tree(to_unit(soup, frame));
  int num_hits = 0, num_clear = 0;
  for (int i = 0; i < 2000; ++i) {
    const TriId source(random() % soup.num_tris());
    const auto c = tree.surface().corners(source);
    const Vec3 from = (c[0] + c[1] + c[2]) / 3, dir = normalized(test::random_point(random));
    bool is_clear = true;
    double expected = kInfinity;
    for (TriId t : soup.tris.ids())
      if (t != source)
        expected = std::min(expected, brute_hit(tree.surface().corners(t), from, dir, is_clear));
    if (!is_clear) continue;
    ++num_clear;
    const auto hit = first_wall(tree, from, source, dir);
    ASSERT_EQ(hit.has_value(), expected < kInfinity) << "ray " << i;
    if (!hit) continue;
    ++num_hits;
    EXPECT_NEAR(hit->length, expected, 1e-9) << "ray " << i;
  }
  EXPECT_GT(num_clear, 1000);
  EXPECT_GT(num_hits, 300);
}

// Rays at the edges and vertices of a closed surface, where rounding would let some slip through.
TEST(FirstWall, NoRayLeavesAClosedSurfaceThroughItsEdges) {
  for (const TriMesh& surface : {test::unit_cube_surface(), test::unit_sphere_surface(3)}) {
    const SurfaceTree tree(surface);
    const Vec3 from = tree.box().center() + Vec3{0.03, 0.01, 0.02};
    int num_rays = 0;
    for (TriId t : surface.tris.ids()) {
      const auto c = surface.corners(t);
      for (std::size_t k = 0; k < 3; ++k)
        for (double along : {0.0, 0.25, 0.5, 0.9}) {
          const Vec3 at = c[k] + (c[(k + 1) % 3] - c[k]) * along;
          const auto hit =
              tree.first_hit(from, normalized(at - from), [](const RayHit&) { return true; });
          ASSERT_TRUE(hit.has_value());
          EXPECT_NEAR(hit->length, distance(at, from), 1e-9);
          ++num_rays;
        }
    }
    EXPECT_GT(num_rays, 100);
  }
}

TEST(FirstWall, PassesThroughItsOwnTriangleAndItsPlane) {
  TriMesh two = test::unit_cube_surface();
  const TriMesh once = two;
  for (const auto& tri : once.tris) two.tris.push_back(tri);  // every wall twice
  const SurfaceTree tree(two);
  const auto c = two.corners(TriId(0));
  const Vec3 from = (c[0] + c[1] + c[2]) / 3;
  const auto hit = first_wall(tree, from, TriId(0), -tree.normal(TriId(0)));
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->length, 1, 1e-12);
  EXPECT_LT(hit->tri.index(), once.num_tris());  // of two that are equally near the first
}

// Equal parts of the cap's area hold equal numbers of rays, so their mean is the cap's centroid.
TEST(SpreadCone, RaysCoverTheCapEvenly) {
  for (double half : {0.1, 0.6, std::numbers::pi / 3, std::numbers::pi / 2}) {
    const auto rays = spread_cone(2000, half);
    ASSERT_EQ(rays.size(), 2000u);
    Vec3 mean;
    double last = 0;
    for (const ConeRay& ray : rays) {
      EXPECT_NEAR(norm(ray.direction), 1, 1e-12);
      EXPECT_NEAR(std::cos(ray.angle), ray.direction.z, 1e-12);
      EXPECT_GT(ray.angle, last);  // from the axis outwards, never on it
      EXPECT_LT(ray.angle, half);
      last = ray.angle;
      mean += ray.direction / 2000.0;
    }
    EXPECT_NEAR(mean.x, 0, 2e-3);
    EXPECT_NEAR(mean.y, 0, 2e-3);
    EXPECT_NEAR(mean.z, (1 + std::cos(half)) / 2, 1e-6);  // Archimedes: uniform along the axis
  }
}

TEST(AxisFrame, IsARightHandedOrthonormalFrameAboutAnyAxis) {
  std::mt19937_64 random(52);
  std::vector<Vec3> axes = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 200; ++i) axes.push_back(normalized(test::random_point(random)));
  for (const Vec3& n : axes) {
    const AxisFrame f(n);
    EXPECT_EQ(f.z, n);
    EXPECT_NEAR(det(f.x, f.y, f.z), 1, 1e-12);
    EXPECT_NEAR(norm(f.x), 1, 1e-12);
    EXPECT_NEAR(norm(f.y), 1, 1e-12);
    EXPECT_NEAR(dot(f.x, f.y), 0, 1e-12);
    EXPECT_EQ(f.to_world({0, 0, 1}), n);
  }
}

/// A sphere of latitudes and longitudes; its vertices lie on the sphere of the given radius.
TriMesh round_sphere(int n, double radius, const Vec3& center) {
  TriMesh sphere;
  const VertId south = sphere.positions.push_back(center - Vec3{0, 0, radius});
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const double a = std::numbers::pi * (double(i) / n - 0.5), b = std::numbers::pi * j / n;
      sphere.positions.push_back(
          center +
          Vec3{std::cos(a) * std::cos(b), std::cos(a) * std::sin(b), std::sin(a)} * radius);
    }
  const VertId north = sphere.positions.push_back(center + Vec3{0, 0, radius});
  const auto at = [&](int i, int j) {
    return i == 0 ? south : i == n ? north : VertId(1 + (i - 1) * 2 * n + j % (2 * n));
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      if (i > 0) sphere.tris.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      if (i + 1 < n) sphere.tris.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    }
  return sphere;
}

// A chord at angle a from the inward normal of a sphere is 2 r cos a long; a narrow cone measures
// the diameter, whatever the radius.
TEST(ShapeDiameter, ANarrowConeMeasuresTheDiameterOfASphere) {
  for (double radius : {0.01, 1.0, 40.0}) {
    const TriMesh sphere = round_sphere(24, radius, {3, -2, 1});
    ShapeDiameterOptions narrow;
    narrow.cone_angle = 0.05;
    for (double d : compute_shape_diameter(sphere, narrow, {}))
      EXPECT_NEAR(d, 2 * radius, 0.02 * radius);
  }
}

// Rays are laid out about the normal in a fixed frame; a rotation changes that frame and hence the
// rays, but not what they measure by more than the sampling's own error.
TEST(ShapeDiameter, HardlyChangesUnderRotation) {
  const TriMesh sphere = round_sphere(12, 1, {});
  TriMesh turned = sphere;
  for (Vec3& p : turned.positions) p = {p.z, p.x, p.y};
  ShapeDiameterOptions options;
  options.num_rays = 200;
  const auto a = compute_shape_diameter(sphere, options, {});
  const auto b = compute_shape_diameter(turned, options, {});
  for (TriId t : sphere.tris.ids()) EXPECT_NEAR(a[t], b[t], 0.05);
}

TEST(ShapeDiameter, RefusesConesAndRayCountsThatMeasureNothing) {
  const TriMesh cube = test::unit_cube_surface();
  for (const ShapeDiameterOptions& bad :
       {ShapeDiameterOptions{0, 25}, ShapeDiameterOptions{-1, 25}, ShapeDiameterOptions{4, 25},
        ShapeDiameterOptions{std::nan(""), 25}, ShapeDiameterOptions{1, 0}})
    EXPECT_THROW(compute_shape_diameter(cube, bad, {}), Error);
}

TEST(ShapeDiameter, DoesNotDependOnThreads) {
  const TriMesh sphere = round_sphere(16, 1, {});
  const auto many = compute_shape_diameter(sphere, {}, {});
  const ThreadLimit one(1);
  EXPECT_EQ(compute_shape_diameter(sphere, {}, {}), many);
}

// Walls of concentric spheres: outside measures the gap in the hollow, inside the shell.
TEST(OppositeWalls, AShellMeasuresItsThicknessAndItsHollow) {
  TriMesh shell = round_sphere(20, 1, {});
  const TriMesh hollow = round_sphere(20, 0.6, {});
  const std::size_t num_outer = shell.num_tris();
  append(shell, test::reversed(hollow));  // the solid lies outside of the hollow
  // From the outer wall the straight ray is the shortest. From the hollow, rays at 36 degrees reach
  // the outer wall after sqrt(1 - (0.6 sin 36)^2) - 0.6 cos 36, times their cosine: 0.364.
  // Across the hollow, chords at angle a measure 1.2 cos^2 a, and their ends face while cos 2a is
  // above 0.8: 1.08 to 1.2.
  for (const WallSample& s : sample_opposite_walls(shell, 0.2, {})) {
    if (s.tri.index() < num_outer) {
      EXPECT_NEAR(s.inner, 0.4, 0.02);
      EXPECT_EQ(s.outer, kInfinity);
    } else {
      EXPECT_GT(s.inner, 0.35);
      EXPECT_LT(s.inner, 0.42);
      EXPECT_GT(s.outer, 1.04);
      EXPECT_LT(s.outer, 1.21);
    }
  }
}

}  // namespace
}  // namespace hexwright
