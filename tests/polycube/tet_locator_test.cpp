// The tet locator and the boundary of tet meshes against brute force.
#include "polycube/tets/tet_locator.h"

#include <map>
#include <numeric>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"

#include "geometry/random_soup.h"
#include "polycube/tet_builders.h"
#include "polycube/tets/tet_boundary.h"

namespace hexwright::polycube {
namespace {

/// Cubes of a 3 x 3 x 3 block, each with a chance of two thirds; never none.
std::vector<LatticeCoord> random_cubes(std::mt19937_64& random) {
  std::vector<LatticeCoord> cubes = {{1, 1, 1}};
  for (int i = 0; i < 27; ++i)
    if (i != 13 && random() % 3 != 0) cubes.push_back({i % 3, i / 3 % 3, i / 9});
  return cubes;
}

/// All vertices moved at random, far enough that some tets fold over.
TetMesh shaken(TetMesh mesh, double amount, std::mt19937_64& random) {
  for (Vec3& p : mesh.positions) p += test::random_point(random, amount);
  return mesh;
}

/// Positive tets whose volume is not lost in rounding; the locator knows no others.
std::vector<TetId> positive_tets(const TetMesh& mesh) {
  std::vector<TetId> tets;
  for (TetId t : mesh.tets.ids())
    if (tet_det(tet_corners(mesh, t)) > 1e-12) tets.push_back(t);
  return tets;
}

double least_weight(const TetMesh& mesh, TetId t, const Vec3& p) {
  const auto w = barycentric(tet_corners(mesh, t), p);
  return *std::min_element(w.begin(), w.end());
}

double distance_to_tet(const TetMesh& mesh, TetId t, const Vec3& p) {
  if (least_weight(mesh, t, p) >= 0) return 0;
  const auto c = tet_corners(mesh, t);
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 4; ++k)
    best =
        std::min(best, test::brute_distance(p, {c[(k + 1) % 4], c[(k + 2) % 4], c[(k + 3) % 4]}));
  return best;
}

// On folded meshes several positive tets may hold a point: the one it is deepest in is asked for.
// A point in none is taken to the nearest place in one.
TEST(TetLocator, AgreesWithAScanOverAllTets) {
  std::mt19937_64 random(31);
  int num_inside = 0, num_bridged = 0, num_overlaps = 0;
  for (double amount : {0.0, 0.05, 0.2, 0.5}) {
    const TetMesh mesh = shaken(test::tet_cubes(random_cubes(random), 2), amount, random);
    const auto tets = positive_tets(mesh);
    const TetLocator locator(mesh);
    EXPECT_EQ(locator.num_nonpositive(), mesh.num_tets() - tets.size());
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = Vec3{1.5, 1.5, 1.5} + test::random_point(random, 2);
      TetId deepest;
      double depth = 0, nearest = std::numeric_limits<double>::infinity();
      int num_around = 0;
      for (TetId t : tets) {
        const double w = least_weight(mesh, t, p);
        num_around += w > 0;
        if (w > depth) {
          depth = w;
          deepest = t;
        }
        nearest = std::min(nearest, distance_to_tet(mesh, t, p));
      }
      if (nearest < 1e-7 && !(depth > 1e-7)) continue;  // on a facet, by rounding
      const TetPoint found = locator.locate(p);
      EXPECT_NEAR(std::accumulate(found.weight.begin(), found.weight.end(), 0.0), 1, 1e-12);
      EXPECT_GE(*std::min_element(found.weight.begin(), found.weight.end()), 0);
      EXPECT_EQ(found.is_bridged, !deepest.is_valid());
      if (deepest.is_valid()) {
        EXPECT_EQ(found.tet, deepest);
      }
      EXPECT_NEAR(distance(interpolate(mesh, found), p), nearest, 1e-9);
      num_inside += deepest.is_valid();
      num_bridged += found.is_bridged;
      num_overlaps += num_around > 1;
    }
  }
  EXPECT_GT(num_inside, 100);
  EXPECT_GT(num_bridged, 100);
  EXPECT_GT(num_overlaps, 5);  // the folded mesh does cover places twice
}

TEST(TetLocator, VerticesBelongToTheLowestTetAroundThem) {
  const TetMesh mesh = test::tet_cubes({{0, 0, 0}, {1, 0, 0}}, 2);
  const TetLocator locator(mesh);
  IdVector<VertId, TetId> lowest(mesh.num_verts());
  for (TetId t : mesh.tets.ids())
    for (VertId v : mesh.tets[t])
      if (!lowest[v].is_valid()) lowest[v] = t;
  for (VertId v : mesh.positions.ids()) {
    const TetPoint at = locator.locate(mesh.positions[v]);
    EXPECT_EQ(at.tet, lowest[v]);
    EXPECT_FALSE(at.is_bridged);
    EXPECT_EQ(interpolate(mesh, at), mesh.positions[v]);
  }
}

TEST(TetLocator, FollowsScaleAndPosition) {
  std::mt19937_64 random(32);
  const TetMesh mesh = shaken(test::tet_cubes({{0, 0, 0}}, 2), 0.05, random);
  const TetLocator locator(mesh);
  for (double scale : {1e-60, 1e-6, 1e6, 1e60}) {
    const Vec3 shift = {100, -50, 20};
    const TetMesh moved = test::mapped(mesh, [&](Vec3 p) { return (p + shift) * scale; });
    const TetLocator there(moved);
    EXPECT_EQ(there.num_nonpositive(), locator.num_nonpositive());
    for (int i = 0; i < 100; ++i) {
      const Vec3 p = Vec3{0.5, 0.5, 0.5} + test::random_point(random, 0.4);
      const TetPoint a = locator.locate(p), b = there.locate((p + shift) * scale);
      if (*std::min_element(a.weight.begin(), a.weight.end()) < 1e-6) continue;
      EXPECT_EQ(a.tet, b.tet) << scale;
      EXPECT_EQ(a.is_bridged, b.is_bridged) << scale;
    }
  }
}

TEST(TetLocator, WithoutAnyPositiveTetThereIsNothingToLocate) {
  TetMesh mesh = test::tet_cubes({{0, 0, 0}}, 1);
  for (auto& tet : mesh.tets) std::swap(tet[0], tet[1]);
  try {
    const TetLocator locator(mesh);
    FAIL() << "a mesh of inverted tets was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadGeometry);
    EXPECT_NE(std::string(error.what()).find("vertex order"), std::string::npos);
  }
}

TEST(Barycentric, WeightsReproduceThePointAndNameTheOppositeFacet) {
  std::mt19937_64 random(33);
  for (int i = 0; i < 300; ++i) {
    std::array<Vec3, 4> tet;
    for (Vec3& p : tet) p = test::random_point(random);
    if (std::abs(tet_det(tet)) < 0.05) continue;
    const Vec3 p = test::random_point(random, 2);
    const auto w = barycentric(tet, p);
    Vec3 sum;
    for (std::size_t k = 0; k < 4; ++k) sum += tet[k] * w[k];
    EXPECT_NEAR(w[0] + w[1] + w[2] + w[3], 1, 1e-11);
    EXPECT_NEAR(distance(sum, p), 0, 1e-11);
    // A weight is the height over the opposite facet in heights of the tet.
    for (std::size_t k = 0; k < 4; ++k) {
      const auto on_facet = barycentric(tet, (tet[(k + 1) % 4] + tet[(k + 2) % 4]) * 0.5);
      EXPECT_NEAR(on_facet[k], 0, 1e-12);
    }
  }
}

TEST(TetBoundary, AreTheFacetsOfExactlyOneTet) {
  std::mt19937_64 random(34);
  for (int round = 0; round < 10; ++round) {
    const TetMesh mesh = test::tet_cubes(random_cubes(random), 1);
    std::map<std::array<VertId, 3>, int> count;
    for (const auto& tet : mesh.tets)
      for (std::size_t k = 0; k < 4; ++k) {
        std::array<VertId, 3> key = {tet[(k + 1) % 4], tet[(k + 2) % 4], tet[(k + 3) % 4]};
        std::sort(key.begin(), key.end());
        ++count[key];
      }
    std::size_t expected = 0;
    for (const auto& [key, n] : count) expected += n == 1;
    const auto facets = boundary_facets(mesh);
    EXPECT_EQ(facets.size(), expected);
    double volume = 0;
    for (auto facet : facets) {
      const auto& x = mesh.positions;
      volume += det(x[facet[0]], x[facet[1]], x[facet[2]]) / 6;
      std::sort(facet.begin(), facet.end());
      EXPECT_EQ(count[facet], 1);
    }
    EXPECT_NEAR(volume, double(mesh.num_tets()) / 6, 1e-10);  // outward, all of them
  }
}

}  // namespace
}  // namespace hexwright::polycube
