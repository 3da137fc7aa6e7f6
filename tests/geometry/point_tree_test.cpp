// Boxes of a point tree against a scan over all points.
#include "geometry/tree/point_tree.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "geometry/random_soup.h"

namespace hexwright {
namespace {

std::vector<std::size_t> visited(const PointTree& tree, const Box3& box) {
  std::vector<std::size_t> found;
  tree.visit_box(box, [&](std::size_t i) { found.push_back(i); });
  return found;
}

std::vector<std::size_t> scanned(const std::vector<Vec3>& points, const Box3& box) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (box.contains(points[i])) found.push_back(i);
  return found;
}

/// Points on a coarse lattice, so that many share a coordinate or coincide: the case in which a
/// split plane has points on both of its sides.
std::vector<Vec3> lattice_points(std::size_t count, std::mt19937_64& random) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 p = test::random_point(random, 3);
    points.push_back({std::round(p.x), std::round(p.y), std::round(p.z)});
  }
  return points;
}

TEST(PointTree, BoxesHoldWhatAScanFinds) {
  std::mt19937_64 random(41);
  for (std::size_t count : {0u, 1u, 8u, 9u, 17u, 300u, 2000u}) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back(test::random_point(random, 3));
    for (const auto& set : {points, lattice_points(count, random)}) {
      const PointTree tree(set);
      for (int query = 0; query < 50; ++query) {
        Box3 box;
        box.extend(test::random_point(random, 3));
        box.extend(test::random_point(random, 3));
        auto found = visited(tree, box);
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, scanned(set, box)) << count << " points, query " << query;
      }
    }
  }
}

// Each point is found in the box that is that point alone, once, with all its twins.
TEST(PointTree, TheBoxIsClosed) {
  std::mt19937_64 random(42);
  const auto points = lattice_points(500, random);
  const PointTree tree(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto found = visited(tree, Box3{points[i], points[i]});
    std::sort(found.begin(), found.end());
    EXPECT_TRUE(std::binary_search(found.begin(), found.end(), i));
    EXPECT_EQ(found, scanned(points, Box3{points[i], points[i]}));
  }
}

TEST(PointTree, AnEmptyBoxHoldsNothingAndCoincidentPointsDoNotRecurseForEver) {
  const PointTree tree(std::vector<Vec3>(1000, Vec3{1, 2, 3}));
  EXPECT_TRUE(visited(tree, Box3{}).empty());
  EXPECT_EQ(visited(tree, Box3{{1, 2, 3}, {1, 2, 3}}).size(), 1000u);
  EXPECT_TRUE(visited(tree, Box3{{1, 2, 3.5}, {2, 3, 4}}).empty());
}

}  // namespace
}  // namespace hexwright
