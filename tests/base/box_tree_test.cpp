// The tree against scans over all items.
#include "base/box_tree.h"

#include <random>

#include <gtest/gtest.h>

namespace hexwright {
namespace {

using Item = BoxTree::Item;

/// Boxes with corners on a lattice of 9 x 9 x 9 points: many touch, share their centre or are the
/// same.
std::vector<Box3> lattice_boxes(std::size_t count, std::mt19937_64& random) {
  const auto place = [&] { return static_cast<double>(random() % 9); };
  std::vector<Box3> boxes(count);
  for (Box3& box : boxes) {
    box.extend(Vec3{place(), place(), place()});
    if (random() % 3 > 0) box.extend(Vec3{place(), place(), place()});
  }
  return boxes;
}

std::vector<Item> overlapping(const BoxTree& tree, const std::vector<Box3>& boxes,
                              const Box3& query) {
  std::vector<Item> found;
  tree.visit([&](const Box3& node) { return do_overlap(node, query); },
             [&](Item i) {
               if (do_overlap(boxes[i], query)) found.push_back(i);
             });
  std::sort(found.begin(), found.end());
  return found;
}

TEST(BoxTree, FindsEveryBoxOnce) {
  std::mt19937_64 random(1);
  for (std::size_t count : {0u, 1u, 8u, 9u, 17u, 63u, 64u, 65u, 1000u}) {
    const auto boxes = lattice_boxes(count, random);
    const BoxTree tree(boxes);
    for (const Box3& query : lattice_boxes(50, random)) {
      std::vector<Item> expected;
      for (Item i = 0; i < count; ++i)
        if (do_overlap(boxes[i], query)) expected.push_back(i);
      EXPECT_EQ(overlapping(tree, boxes, query), expected) << count << " boxes";
    }
  }
}

TEST(BoxTree, LooksAtFewOfManyBoxes) {
  std::vector<Box3> boxes;
  for (int i = 0; i < 4096; ++i) {
    const Vec3 p{double(i % 16), double(i / 16 % 16), double(i / 256)};
    boxes.push_back({p, p});
  }
  const BoxTree tree(boxes);
  std::size_t num_visited = 0;
  const Box3 query{{7, 7, 7}, {8, 8, 8}};  // holds 8 points
  tree.visit([&](const Box3& node) { return do_overlap(node, query); },
             [&](Item) { ++num_visited; });
  EXPECT_GE(num_visited, 8u);
  EXPECT_LE(num_visited, 64u);
}

TEST(BoxTree, StopsAtTheFirstThatIsAccepted) {
  const BoxTree tree(std::vector<Box3>(100, Box3{{0, 0, 0}, {1, 1, 1}}));
  const auto always = [](const Box3&) { return true; };
  std::size_t num_asked = 0;
  EXPECT_TRUE(tree.find(always, [&](Item) { return ++num_asked == 3; }));
  EXPECT_EQ(num_asked, 3u);
  EXPECT_FALSE(tree.find(always, [](Item) { return false; }));
  EXPECT_FALSE(BoxTree().find(always, [](Item) { return true; }));
}

TEST(BoxTree, FindsTheNearest) {
  std::mt19937_64 random(2);
  for (std::size_t count : {1u, 9u, 500u}) {
    const auto boxes = lattice_boxes(count, random);
    const BoxTree tree(boxes);
    std::uniform_real_distribution<double> place(-4, 12);
    for (int query = 0; query < 100; ++query) {
      const Vec3 p{place(random), place(random), place(random)};
      double expected = std::numeric_limits<double>::infinity();
      for (const Box3& box : boxes) expected = std::min(expected, distance_sq(box, p));
      double best = std::numeric_limits<double>::infinity();
      tree.visit_nearest(p,
                         [&](Item i) { return best = std::min(best, distance_sq(boxes[i], p)); });
      EXPECT_EQ(best, expected) << count << " boxes, query " << query;
    }
  }
}

TEST(BoxTree, HoldsTheBoxAroundAll) {
  EXPECT_TRUE(BoxTree().box().is_empty());
  const std::vector<Box3> boxes = {{{0, 0, 0}, {1, 1, 1}}, {{-2, 0, 0}, {-1, 3, 0}}};
  EXPECT_EQ(BoxTree(boxes).box().lo, (Vec3{-2, 0, 0}));
  EXPECT_EQ(BoxTree(boxes).box().hi, (Vec3{1, 3, 1}));
}

TEST(Box3, DistanceIsThatOfTheNearestPoint) {
  const Box3 box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_EQ(distance_sq(box, {0.5, 1, 3}), 0);
  EXPECT_EQ(distance_sq(box, {-1, 1, 1}), 1);
  EXPECT_EQ(distance_sq(box, {3, 4, 6}), 4 + 4 + 9);
}

}  // namespace
}  // namespace hexwright
