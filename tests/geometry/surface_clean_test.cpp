// The passes of the preparation one by one: edges, welding, duplicates, patches over holes.
#include "geometry/prepare/surface_clean.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "hexwright/geometry/surface_topology.h"

#include "geometry/features/edges_along.h"
#include "geometry/random_soup.h"
#include "helpers.h"
#include "mesh/tri_measures.h"

namespace hexwright {
namespace {

constexpr double kPi = 3.14159265358979323846;

WorkingSurface working(const TriMesh& mesh) {
  WorkingSurface w{mesh, {}, {}};
  for (TriId t : mesh.tris.ids()) w.source.push_back(t);
  return w;
}

/// The sphere with shared vertices.
TriMesh welded_sphere(int depth) {
  TriMesh sphere = test::unit_sphere_surface(depth);
  weld_open_edges(sphere);
  return sphere;
}

double area_of(const TriMesh& mesh, const std::array<VertId, 3>& t) {
  const auto& x = mesh.positions;
  return norm(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]])) / 2;
}

TEST(SurfaceEdges, AgreeWithAMapOverAllSides) {
  std::mt19937_64 random(91);
  for (int round = 0; round < 20; ++round) {
    TriMesh mesh;
    for (int v = 0; v < 12; ++v) mesh.positions.push_back({});
    for (int t = 0; t < 40; ++t)  // vertices repeat within triangles too
      mesh.tris.push_back({VertId(random() % 12), VertId(random() % 12), VertId(random() % 12)});
    std::map<std::pair<int, int>, std::vector<std::array<int, 3>>> expected;
    for (TriId t : mesh.tris.ids())
      for (int k = 0; k < 3; ++k) {
        const int a = mesh.tris[t][std::size_t(k)].value();
        const int b = mesh.tris[t][std::size_t((k + 1) % 3)].value();
        if (a != b) expected[{std::min(a, b), std::max(a, b)}].push_back({t.value(), k, a < b});
      }
    const SurfaceEdges edges = compute_surface_edges(mesh);
    ASSERT_EQ(edges.size(), expected.size());
    std::size_t e = 0, num_odd = 0;
    for (const auto& [key, sides] : expected) {  // maps and edges are in the same order
      EXPECT_EQ(edges.lo(e), VertId(key.first));
      EXPECT_EQ(edges.hi(e), VertId(key.second));
      EXPECT_EQ(edges.find(VertId(key.second), VertId(key.first)), long(e));
      std::vector<std::array<int, 3>> found;
      for (const auto& s : edges.sides_of(e)) found.push_back({s.tri.value(), s.k, s.is_forward});
      EXPECT_EQ(found, sides);
      num_odd += sides.size() % 2;
      ++e;
    }
    EXPECT_EQ(count_odd_edges(edges), num_odd);
    for (int a = 0; a < 12; ++a)
      for (int b = 0; b < a; ++b)
        EXPECT_EQ(edges.find(VertId(a), VertId(b)) >= 0, expected.contains({b, a}));
  }
}

TEST(SurfaceWeld, ASoupOfASphereBecomesTheSphereWhateverTheOrder) {
  TriMesh soup = test::unit_sphere_surface(3);
  std::mt19937_64 random(92);
  for (int round = 0; round < 4; ++round) {
    TriMesh mesh = soup;
    const std::size_t num_welded = weld_open_edges(mesh);
    const SurfaceTopology t = compute_topology(mesh);
    EXPECT_TRUE(t.is_closed_manifold());
    EXPECT_EQ(t.euler_characteristic, 2);
    std::set<VertId> used;
    for (const auto& tri : mesh.tris) used.insert(tri.begin(), tri.end());
    EXPECT_EQ(used.size(), mesh.num_tris() / 2 + 2);  // Euler, of a closed triangle surface
    EXPECT_GT(num_welded, 0u);
    std::shuffle(soup.tris.begin(), soup.tris.end(), random);
  }
}

TEST(SurfaceWeld, NoiseBelowTheToleranceIsWeldedAndAGapAboveItIsNot) {
  for (double noise : {1e-10, 1e-8, 1e-6, 1e-3}) {
    std::mt19937_64 random(93);
    TriMesh mesh = test::unit_sphere_surface(2);
    for (Vec3& p : mesh.positions) p += test::random_point(random, noise / 4);
    weld_open_edges(mesh);
    EXPECT_EQ(compute_topology(mesh).is_closed_manifold(), noise < 1e-5) << noise;
  }
}

// Groups of triangles on the same three vertices: what remains has no two of a kind.
TEST(DuplicateTriangles, OneOrNoneOfEachGroupRemains) {
  std::mt19937_64 random(94);
  for (int round = 0; round < 30; ++round) {
    TriMesh mesh = welded_sphere(1);
    const std::size_t num_before = mesh.num_tris();
    for (int i = 0; i < 10; ++i) {
      auto tri = mesh.tris[TriId(random() % num_before)];
      std::rotate(tri.begin(), tri.begin() + long(random() % 3), tri.end());
      if (random() % 2) std::swap(tri[0], tri[1]);
      mesh.tris.push_back(tri);
    }
    WorkingSurface surface = working(mesh);
    const std::size_t num_dropped = remove_duplicate_tris(surface);
    EXPECT_EQ(surface.mesh.num_tris() + num_dropped, mesh.num_tris());
    EXPECT_EQ(surface.source.size(), surface.mesh.num_tris());
    std::set<std::set<VertId>> groups;
    for (TriId t : surface.mesh.tris.ids()) {
      const auto& tri = surface.mesh.tris[t];
      EXPECT_TRUE(groups.insert({tri.begin(), tri.end()}).second);
      EXPECT_EQ(tri, mesh.tris[surface.source[t]]);
    }
    // Doubling a side of a closed surface must not open it.
    EXPECT_EQ(count_odd_edges(compute_surface_edges(surface.mesh)), 0u);
    EXPECT_EQ(remove_duplicate_tris(surface), 0u);  // nothing is left to do
  }
}

TEST(DuplicateTriangles, TheWallBetweenTwoTouchingTetrahedraCancels) {
  TriMesh two;
  for (int v = 0; v < 5; ++v) two.positions.push_back({});
  const auto tri = [&](int a, int b, int c) {
    two.tris.push_back({VertId(a), VertId(b), VertId(c)});
  };
  tri(0, 1, 2), tri(0, 3, 1), tri(1, 3, 2), tri(2, 3, 0);
  tri(0, 2, 1), tri(0, 1, 4), tri(1, 2, 4), tri(2, 0, 4);
  WorkingSurface surface = working(two);
  EXPECT_EQ(remove_duplicate_tris(surface), 2u);
  EXPECT_TRUE(compute_topology(surface.mesh).is_closed_manifold());
  EXPECT_TRUE(is_oriented_cycle(surface.mesh));
}

TEST(DegenerateTriangles, ThoseThatRepeatAVertexGoWithoutOpeningTheSurface) {
  TriMesh mesh = welded_sphere(1);
  const std::size_t num_before = mesh.num_tris();
  mesh.tris.push_back({VertId(0), VertId(0), mesh.tris[TriId(0)][0]});
  mesh.tris.push_back({mesh.tris[TriId(1)][0], mesh.tris[TriId(1)][1], mesh.tris[TriId(1)][0]});
  WorkingSurface surface = working(mesh);
  std::size_t num_kept = 99;
  EXPECT_EQ(remove_degenerate_tris(surface, num_kept), 2u);
  EXPECT_EQ(num_kept, 0u);
  EXPECT_EQ(surface.mesh.num_tris(), num_before);
  EXPECT_TRUE(compute_topology(surface.mesh).is_closed_manifold());
}

/// A cone whose rim is the given loop and whose apex lies far below: a surface with one hole.
TriMesh cone_over(const std::vector<Vec3>& rim) {
  TriMesh cone;
  Vec3 middle;
  for (const Vec3& p : rim) {
    cone.positions.push_back(p);
    middle += p / double(rim.size());
  }
  const VertId apex = cone.positions.push_back(middle - Vec3{0, 0, 2});
  for (std::size_t i = 0; i < rim.size(); ++i)
    cone.tris.push_back({VertId(i), apex, VertId((i + 1) % rim.size())});
  return cone;
}

/// Area x 2 and a hundredth of the squared lengths: what a patch costs, as its source says.
double cost_of(const TriMesh& mesh, const std::array<VertId, 3>& t) {
  const auto& x = mesh.positions;
  return 2 * area_of(mesh, t) + 0.01 * (norm_sq(x[t[1]] - x[t[0]]) + norm_sq(x[t[2]] - x[t[1]]) +
                                        norm_sq(x[t[0]] - x[t[2]]));
}

/// The least cost over all triangulations of the polygon i .. j, by trying every one.
double brute_cost(const TriMesh& mesh, int i, int j) {
  if (j - i < 2) return 0;
  double best = std::numeric_limits<double>::infinity();
  for (int k = i + 1; k < j; ++k)
    best = std::min(best, brute_cost(mesh, i, k) + brute_cost(mesh, k, j) +
                              cost_of(mesh, {VertId(i), VertId(k), VertId(j)}));
  return best;
}

TEST(FillHoles, TakesTheCheapestOfAllTriangulations) {
  std::mt19937_64 random(95);
  for (int n = 3; n <= 9; ++n)
    for (int round = 0; round < 5; ++round) {
      std::vector<Vec3> rim;
      for (int i = 0; i < n; ++i)
        rim.push_back(Vec3{std::cos(2 * kPi * i / n), std::sin(2 * kPi * i / n), 0} +
                      test::random_point(random, 0.4));
      WorkingSurface surface = working(cone_over(rim));
      const std::size_t num_before = surface.mesh.num_tris();
      ASSERT_EQ(fill_holes(surface), 1u);
      ASSERT_EQ(surface.mesh.num_tris(), num_before + rim.size() - 2);
      double cost = 0;
      for (TriId t : surface.mesh.tris.ids()) {
        EXPECT_EQ(surface.source[t].is_valid(), t.index() < num_before);
        if (t.index() >= num_before) cost += cost_of(surface.mesh, surface.mesh.tris[t]);
      }
      EXPECT_NEAR(cost, brute_cost(surface.mesh, 0, n - 1), 1e-9);
      EXPECT_TRUE(compute_topology(surface.mesh).is_closed_manifold());
      EXPECT_TRUE(is_oriented_cycle(surface.mesh));
      EXPECT_EQ(fill_holes(surface), 0u);
    }
}

// Plane loops of any shape are covered once: a star, a comb, and one too long to be done at once.
TEST(FillHoles, PlaneLoopsGetTheirOwnArea) {
  std::vector<std::vector<Vec3>> rims(3);
  for (int i = 0; i < 40; ++i) {
    const double r = i % 2 ? 0.4 : 1;
    rims[0].push_back({r * std::cos(2 * kPi * i / 40), r * std::sin(2 * kPi * i / 40), 0});
  }
  for (int i = 0; i <= 12; ++i) rims[1].push_back({i / 12.0, 0, 0});
  for (int i = 12; i >= 0; --i) rims[1].push_back({i / 12.0, i % 2 ? 0.9 : 0.2, 0});
  for (int i = 0; i < 900; ++i)
    rims[2].push_back({std::cos(2 * kPi * i / 900), std::sin(2 * kPi * i / 900), 0});
  for (const auto& rim : rims) {
    double expected = 0;
    for (std::size_t i = 0; i < rim.size(); ++i)
      expected += cross(rim[i], rim[(i + 1) % rim.size()]).z / 2;
    WorkingSurface surface = working(cone_over(rim));
    const std::size_t num_before = surface.mesh.num_tris();
    ASSERT_EQ(fill_holes(surface), 1u);
    double area = 0, signed_area = 0;
    for (TriId t : surface.mesh.tris.ids()) {
      if (t.index() < num_before) continue;
      const auto c = surface.mesh.corners(t);
      area += area_of(surface.mesh, surface.mesh.tris[t]);
      signed_area += cross(c[1] - c[0], c[2] - c[0]).z / 2;
    }
    EXPECT_NEAR(signed_area, expected, 1e-12) << rim.size();
    EXPECT_NEAR(area, expected, 2e-3) << rim.size();  // nothing is covered twice
    EXPECT_TRUE(compute_topology(surface.mesh).is_closed_manifold());
  }
}

TEST(FillHoles, HolesThatMeetInAVertexComeApart) {
  TriMesh sphere = welded_sphere(3);
  // Two triangles that share a vertex but no edge are cut out.
  const auto first = sphere.tris[TriId(0)];
  TriId second;
  for (TriId t : sphere.tris.ids()) {
    int shared = 0;
    for (VertId v : sphere.tris[t])
      shared += std::find(first.begin(), first.end(), v) != first.end();
    if (shared == 1) second = t;
  }
  ASSERT_TRUE(second.is_valid());
  WorkingSurface surface = working(sphere);
  std::vector<char> is_kept(sphere.num_tris(), 1);
  is_kept[0] = is_kept[second.index()] = 0;
  surface.keep(is_kept);
  EXPECT_EQ(fill_holes(surface), 2u);
  EXPECT_TRUE(compute_topology(surface.mesh).is_closed_manifold());
  EXPECT_TRUE(is_oriented_cycle(surface.mesh));
  EXPECT_EQ(surface.mesh.num_tris(), sphere.num_tris());
}

// The volume of any closed surface is the same about every origin, negates when turned, and scales
// by the cube.
TEST(EnclosedVolume, IsThatOfTheSolid) {
  TriMesh cube = test::unit_cube_surface();
  EXPECT_NEAR(enclosed_volume(cube), 1, 1e-12);
  for (Vec3& p : cube.positions) p = p * 3.0 + Vec3{1000, -2000, 500};
  EXPECT_NEAR(enclosed_volume(cube), 27, 1e-9);
  EXPECT_NEAR(total_area(cube), 6 * 9, 1e-9);
  for (auto& t : cube.tris) std::swap(t[0], t[1]);
  EXPECT_NEAR(enclosed_volume(cube), -27, 1e-9);
  EXPECT_EQ(enclosed_volume({}), 0);
}

/// A flat sheet of n x n unit squares, each cut along the diagonal from low to high.
TriMesh sheet(int n) {
  TriMesh mesh;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) mesh.positions.push_back({double(x), double(y), 0});
  const auto id = [&](int x, int y) { return VertId(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      mesh.tris.push_back({id(x, y), id(x + 1, y), id(x + 1, y + 1)});
      mesh.tris.push_back({id(x, y), id(x + 1, y + 1), id(x, y + 1)});
    }
  return mesh;
}

// On the sheet exactly the segments along the axes and the cut diagonal follow edges.
TEST(EdgesAlong, SegmentsMatchExactlyWhereTheLatticeHasEdges) {
  const int n = 6;
  const TriMesh mesh = sheet(n);
  std::mt19937_64 random(96);
  int num_matched = 0;
  for (int i = 0; i < 400; ++i) {
    const auto pick = [&] { return double(random() % (n + 1)); };
    const Vec3 a = {pick(), pick(), 0}, b = {pick(), pick(), 0};
    const double dx = b.x - a.x, dy = b.y - a.y;
    const bool has_edges = (dx != 0 || dy != 0) && (dx == 0 || dy == 0 || dx == dy);
    const std::array<Vec3, 2> segment = {a, b};
    const EdgesAlong found = find_edges_along(mesh, {&segment, 1});
    ASSERT_EQ(found.num_unmatched, has_edges ? 0u : 1u)
        << a.x << " " << a.y << " to " << b.x << " " << b.y;
    ASSERT_EQ(found.edges.size(),
              has_edges ? std::size_t(std::max(std::abs(dx), std::abs(dy))) : 0);
    if (!has_edges) continue;
    ++num_matched;
    EXPECT_EQ(mesh.positions[found.edges.front()[0]], a);
    EXPECT_EQ(mesh.positions[found.edges.back()[1]], b);
    const SurfaceEdges edges = compute_surface_edges(mesh);
    for (const auto& [v, w] : found.edges) EXPECT_GE(edges.find(v, w), 0);
  }
  EXPECT_GT(num_matched, 50);
}

TEST(EdgesAlong, TheToleranceFollowsTheModelsSize) {
  for (double scale : {1e-6, 1.0, 1e6}) {
    TriMesh mesh = sheet(4);
    for (Vec3& p : mesh.positions) p = p * scale;
    const double diagonal = bounding_box(mesh).diagonal();
    for (double off : {0.5e-5, 1e-4}) {
      const Vec3 shift = {0, 0, off * diagonal};
      const std::array<Vec3, 2> segment = {shift, Vec3{4 * scale, 0, 0} + shift};
      EXPECT_EQ(find_edges_along(mesh, {&segment, 1}).num_unmatched, off < 1e-5 ? 0u : 1u)
          << scale << " " << off;
    }
  }
}

}  // namespace
}  // namespace hexwright
