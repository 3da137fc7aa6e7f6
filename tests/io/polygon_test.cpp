// Polygons of surface files as triangles: random simple polygons in random planes keep their area
// and orientation.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/random_soup.h"
#include "io/surface/polygon_soup.h"

namespace hexwright::io {
namespace {

/// A polygon in the plane z = 0, counter-clockwise.
using Polygon = std::vector<Vec3>;

double unit_random(std::mt19937_64& random) { return double(random() >> 11) / double(1ull << 53); }

/// Simple, because every vertex is seen from the origin; concave nearly always.
Polygon star_polygon(int n, std::mt19937_64& random) {
  Polygon polygon;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.8 * unit_random(random)) / n;
    const double radius = 0.2 + unit_random(random);
    polygon.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return polygon;
}

/// A band that winds around the origin twice and more: most vertices do not see each other.
Polygon spiral_polygon(int n) {
  Polygon polygon;
  const auto at = [&](double t, double radius) {
    return Vec3{radius * std::cos(5 * std::numbers::pi * t),
                radius * std::sin(5 * std::numbers::pi * t), 0};
  };
  for (int i = 0; i <= n; ++i) polygon.push_back(at(double(i) / n, 1 + 3.0 * i / n));
  for (int i = n; i >= 0; --i) polygon.push_back(at(double(i) / n, 0.6 + 3.0 * i / n));
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    area += cross(polygon[i], polygon[(i + 1) % polygon.size()]).z;
  if (area < 0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

double area_of(const Polygon& polygon) {
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    area += cross(polygon[i], polygon[(i + 1) % polygon.size()]).z / 2;
  return area;
}

/// An orthonormal frame with an origin of its own.
struct Frame {
  Vec3 x, y, z, origin;
  Vec3 operator()(const Vec3& p) const { return origin + x * p.x + y * p.y + z * p.z; }
};

Frame random_frame(std::mt19937_64& random, double far) {
  const Vec3 z = normalized(test::random_point(random));
  const Vec3 x = normalized(cross(z, test::random_point(random)));
  return {x, cross(z, x), z, test::random_point(random, far)};
}

PolygonSoup soup_of(const Polygon& polygon, const Frame& frame, std::size_t first) {
  PolygonSoup soup;
  for (const Vec3& p : polygon) soup.positions.push_back(frame(p));
  for (std::size_t i = 0; i < polygon.size(); ++i)
    soup.verts.push_back(VertId((first + i) % polygon.size()));
  soup.end_polygon();
  return soup;
}

/// n - 2 triangles over the polygon's vertices, whose areas sum to the polygon's while all look
/// its way: so they cover it once.
void expect_triangulation(const Polygon& polygon, const Frame& frame, std::size_t first) {
  const TriMesh mesh = triangulate(soup_of(polygon, frame, first));
  ASSERT_EQ(mesh.num_tris(), polygon.size() - 2);
  double sum = 0, absolute = 0;
  for (TriId t : mesh.tris.ids()) {
    const auto c = mesh.corners(t);
    const Vec3 n = cross(c[1] - c[0], c[2] - c[0]) * 0.5;
    sum += dot(n, frame.z);
    absolute += norm(n);
  }
  const double tolerance = 1e-9 * std::max(1.0, area_of(polygon));
  EXPECT_NEAR(sum, area_of(polygon), tolerance);
  EXPECT_NEAR(absolute, area_of(polygon), tolerance) << "a triangle is turned over";
}

TEST(Triangulate, RandomConcavePolygonsAreCoveredOnce) {
  std::mt19937_64 random(51);
  for (int round = 0; round < 300; ++round) {
    const Polygon polygon = star_polygon(4 + int(random() % 40), random);
    expect_triangulation(polygon, random_frame(random, 10), random() % polygon.size());
  }
}

TEST(Triangulate, SpiralsAreCoveredOnceWhereverTheyBegin) {
  std::mt19937_64 random(52);
  for (int n : {10, 40, 150}) {
    const Polygon polygon = spiral_polygon(n);
    for (int round = 0; round < 5; ++round)
      expect_triangulation(polygon, random_frame(random, 1), random() % polygon.size());
  }
}

TEST(Triangulate, ReversedPolygonsGiveTheReversedArea) {
  std::mt19937_64 random(53);
  for (int round = 0; round < 50; ++round) {
    Polygon polygon = star_polygon(5 + int(random() % 20), random);
    const Frame frame = random_frame(random, 1);
    std::reverse(polygon.begin(), polygon.end());
    const TriMesh mesh = triangulate(soup_of(polygon, frame, 0));
    double sum = 0;
    for (TriId t : mesh.tris.ids()) {
      const auto c = mesh.corners(t);
      const double area = dot(cross(c[1] - c[0], c[2] - c[0]), frame.z) / 2;
      EXPECT_LE(area, 1e-12);
      sum += area;
    }
    EXPECT_NEAR(sum, area_of(polygon), 1e-9);
  }
}

// Of a quad's two diagonals the one is taken that folds it less: no other cut has a larger cosine.
TEST(Triangulate, QuadsFoldAsLittleAsTheyCan) {
  std::mt19937_64 random(54);
  const auto fold = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return dot(normalized(cross(b - a, c - a)), normalized(cross(c - a, d - a)));
  };
  for (int round = 0; round < 300; ++round) {
    PolygonSoup soup;
    std::array<Vec3, 4> q;
    for (Vec3& p : q) p = test::random_point(random);
    for (const Vec3& p : q) soup.verts.push_back(soup.positions.push_back(p));
    soup.end_polygon();
    const TriMesh mesh = triangulate(std::move(soup));
    ASSERT_EQ(mesh.num_tris(), 2u);
    const auto a = mesh.corners(TriId(0)), b = mesh.corners(TriId(1));
    const double found = dot(normalized(cross(a[1] - a[0], a[2] - a[0])),
                             normalized(cross(b[1] - b[0], b[2] - b[0])));
    EXPECT_NEAR(found, std::max(fold(q[0], q[1], q[2], q[3]), fold(q[1], q[2], q[3], q[0])), 1e-6);
  }
}

// Whatever is no polygon (crossing itself, on a line, all at one place) still gives n - 2 triangles
// over its own vertices, and comes to an end.
TEST(Triangulate, DegeneratePolygonsGiveAsManyTriangles) {
  std::mt19937_64 random(55);
  for (int round = 0; round < 200; ++round) {
    const std::size_t n = 3 + random() % 12;
    PolygonSoup soup;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 p = test::random_point(random);
      const int kind = round % 4;
      soup.positions.push_back(kind == 0   ? p
                               : kind == 1 ? Vec3{p.x, 0, 0}
                               : kind == 2 ? Vec3{1, 2, 3}
                                           : Vec3{std::round(p.x), std::round(p.y), 0});
      soup.verts.push_back(VertId(random() % (i + 1)));
    }
    soup.end_polygon();
    const TriMesh mesh = triangulate(std::move(soup));
    EXPECT_EQ(mesh.num_tris(), n - 2);
    for (const auto& tri : mesh.tris)
      for (VertId v : tri) EXPECT_LT(v.index(), n);
  }
}

TEST(Triangulate, PolygonsStayInTheOrderOfTheFile) {
  std::mt19937_64 random(56);
  PolygonSoup soup;
  std::vector<std::pair<std::size_t, std::size_t>> owned;  // vertices of each polygon
  for (int p = 0; p < 20; ++p) {
    const std::size_t begin = soup.positions.size();
    for (const Vec3& x : star_polygon(3 + int(random() % 6), random))
      soup.verts.push_back(soup.positions.push_back(x + Vec3{0, 0, double(p)}));
    soup.end_polygon();
    owned.push_back({begin, soup.positions.size()});
  }
  const TriMesh mesh = triangulate(std::move(soup));
  std::size_t next = 0;
  for (const auto& [begin, end] : owned)
    for (std::size_t k = 0; k + 2 < end - begin; ++k, ++next)
      for (VertId v : mesh.tris[TriId(next)]) EXPECT_TRUE(v.index() >= begin && v.index() < end);
  EXPECT_EQ(next, mesh.num_tris());
}

/// A comb: teeth between which nothing is seen from afar.
Polygon comb_polygon(int num_teeth) {
  Polygon polygon = {{0, -1, 0}, {double(num_teeth), -1, 0}};
  for (int i = num_teeth; i-- > 0;) {
    polygon.push_back({i + 0.6, 100, 0});
    polygon.push_back({i + 0.4, 100, 0});
    polygon.push_back({i + 0.0, 0, 0});
  }
  return polygon;
}

/// A square corridor that winds inwards, and back: few corners are ears at any time.
Polygon square_spiral(int num_turns) {
  Polygon polygon, back;
  const std::array<Vec3, 4> ways = {Vec3{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}};
  for (int i = 0; i < 4 * num_turns; ++i) {
    const double radius = num_turns - i / 4.0;
    polygon.push_back(ways[std::size_t(i) % 4] * (radius + 0.2));
    back.push_back(ways[std::size_t(i) % 4] * (radius - 0.2));
  }
  polygon.insert(polygon.end(), back.rbegin(), back.rend());
  return polygon;
}

// Tens of thousands of vertices: an algorithm of quadratic time would take minutes here.
TEST(Triangulate, LargePolygonsAreCoveredOnce) {
  std::mt19937_64 random(57);
  for (const Polygon& polygon :
       {spiral_polygon(10'000), comb_polygon(10'000), square_spiral(3'000)})
    expect_triangulation(polygon, random_frame(random, 1), 0);
}

// Many vertices at a few places, as damaged files have them: still as many triangles, soon.
TEST(Triangulate, CrowdedPolygonsComeToAnEnd) {
  std::mt19937_64 random(58);
  PolygonSoup soup;
  for (int i = 0; i < 9; ++i) soup.positions.push_back(test::random_point(random));
  for (int i = 0; i < 100'000; ++i) soup.verts.push_back(VertId(random() % 9));
  soup.end_polygon();
  EXPECT_EQ(triangulate(std::move(soup)).num_tris(), 99'998u);
}

}  // namespace
}  // namespace hexwright::io
