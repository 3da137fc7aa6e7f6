// All ways in which eight blocks around one lattice vertex may be split.
#include <gtest/gtest.h>

#include "dual/check_grid.h"

namespace hexwright::test {
namespace {

SplitTree pattern(int mask, int margin) {
  const int n = 4 + 2 * margin;
  SplitTree tree(box_roots(n, n, n));
  for (int q = 0; q < 8; ++q)
    if (mask >> q & 1)
      tree.split_block(
          {0,
           {margin + 1 + 2 * (q & 1), margin + 1 + 2 * (q >> 1 & 1), margin + 1 + 2 * (q >> 2)}});
  return tree;
}

TEST(LocalPattern, AllBlocksAroundAVertexInside) {
  for (int mask = 0; mask < 256; ++mask)
    EXPECT_EQ(find_dual_problem(pattern(mask, 1), DualMode::Blocks), "") << mask;
}

TEST(LocalPattern, AllBlocksAroundAVertexFlushWithTheBoundary) {
  for (int mask = 0; mask < 256; ++mask)
    EXPECT_EQ(find_dual_problem(pattern(mask, 0), DualMode::Blocks), "") << mask;
}

// The finer block has every place and parity around the vertex that the coarse pattern allows.
TEST(LocalPattern, FinerBlocksAtTheVertex) {
  for (int mask = 1; mask < 256; mask += 41)
    for (int code = 0; code < 27; ++code) {
      SplitTree tree = pattern(mask, 0);
      const LatticeCoord center = {3 + code % 3, 3 + code / 3 % 3, 3 + code / 9};
      tree.split_block({1, center});
      tree.balance(false);
      EXPECT_EQ(find_dual_problem(tree, DualMode::Sheets), "") << mask << " " << code;
    }
}

// Single nodes instead of blocks: every pattern of the eight nodes at a vertex, by sheets.
TEST(LocalPattern, AllNodesAroundAVertexBySheets) {
  for (int mask = 1; mask < 256; ++mask) {
    SplitTree tree(box_roots(4, 4, 4));
    for (int q = 0; q < 8; ++q)
      if (mask >> q & 1) tree.split(0, {1 + (q & 1), 1 + (q >> 1 & 1), 1 + (q >> 2)});
    EXPECT_EQ(find_dual_problem(tree, DualMode::Sheets), "") << mask;
  }
}

// Found by the random tests and minimised: caps of two pillows met along two edges.
TEST(LocalPattern, CapsThatMeetAlongTwoEdges) {
  SplitTree one_level(box_roots(2, 4, 4));
  for (const LatticeCoord& n : {LatticeCoord{0, 0, 0}, {0, 1, 0}, {0, 2, 2}, {1, 0, 1}, {1, 3, 3}})
    one_level.split(0, n);
  EXPECT_EQ(find_dual_problem(one_level, DualMode::Sheets), "");

  SplitTree two_levels(box_roots(4, 2, 2));
  for (const LatticeCoord& n : {LatticeCoord{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {2, 0, 1}, {2, 1, 1}})
    two_levels.split(0, n);
  for (const LatticeCoord& n : {LatticeCoord{1, 3, 1}, {2, 3, 1}, {3, 3, 2}, {4, 1, 2}, {5, 3, 3}})
    two_levels.split(1, n);
  EXPECT_EQ(find_dual_problem(two_levels, DualMode::Sheets), "");
}

// Found by the random tests and minimised: two nodes that touch at a concave crease of the domain.
TEST(LocalPattern, NodesThatTouchAtAConcaveCrease) {
  std::vector<LatticeCoord> roots;
  for (const LatticeCoord& r : box_roots(4, 4, 4))
    if (r[0] < 2 || r[1] < 2) roots.push_back(r);
  SplitTree tree(roots);
  tree.split(0, {1, 2, 1});
  tree.split(0, {2, 1, 2});
  EXPECT_EQ(find_dual_problem(tree, DualMode::Sheets), "");
}

std::vector<LatticeCoord> domain_around_a_vertex(int mask) {
  std::vector<LatticeCoord> roots;
  for (const LatticeCoord& r : box_roots(4, 4, 4))
    if (mask >> (r[0] / 2 | r[1] / 2 << 1 | r[2] / 2 << 2) & 1) roots.push_back(r);
  return roots;
}

// Every union of the eight roots at a vertex, plain and with a block around the vertex.
TEST(LocalPattern, AllDomainsAroundAVertex) {
  for (int mask = 1; mask < 256; ++mask) {
    const SplitTree plain(domain_around_a_vertex(mask));
    EXPECT_EQ(find_dual_problem(plain, DualMode::Blocks), "") << mask;
    SplitTree refined = plain;
    refined.split_block({0, {2, 2, 2}});
    EXPECT_EQ(find_dual_problem(refined, DualMode::Sheets), "") << mask << " refined";
  }
}

// Where four octants meet in a twisted path, pillows of two depths around the corner itself cannot
// be untangled: the core planes must keep clear of it. All 24 such corners, refined thrice.
TEST(LocalPattern, NestedBlocksAtTwistedCorners) {
  int num_twisted = 0;
  for (int mask = 1; mask < 256; ++mask) {
    SplitTree tree(domain_around_a_vertex(mask));
    if (!has_chiral_corner(tree.roots())) continue;
    ++num_twisted;
    for (int depth = 0; depth < 3; ++depth) {
      const int center = 2 << depth;
      tree.split_block({depth, {center, center, center}});
      for (const DualMode mode : {DualMode::Blocks, DualMode::Sheets})
        EXPECT_EQ(find_dual_problem(tree, mode), "") << mask << " depth " << depth;
    }
  }
  EXPECT_EQ(num_twisted, 24);
}

// Finer nodes beside a twisted corner, in every place that touches it or nearly does.
TEST(LocalPattern, FinerBlocksBesideTwistedCorners) {
  for (int mask = 1; mask < 256; ++mask) {
    const auto roots = domain_around_a_vertex(mask);
    if (!has_chiral_corner(roots)) continue;
    for (int code = mask % 3; code < 27; code += 3) {
      SplitTree tree(roots);
      tree.split_block({1, {3 + code % 3, 3 + code / 3 % 3, 3 + code / 9}});
      tree.balance(false);
      EXPECT_EQ(find_dual_problem(tree, DualMode::Sheets), "") << mask << " " << code;
    }
  }
}

// Found by the random tests: twisted corners an odd number of roots apart, so that no parity of
// core planes avoids both. The mesh is built over smaller roots.
TEST(LocalPattern, TwistedCornersAnOddDistanceApart) {
  check_random_grids({random_paired_tree, random_domain, DualMode::Blocks}, 2347, 2348);
  check_random_grids({random_balanced_tree, random_domain, DualMode::Sheets}, 2347, 2348);
}

}  // namespace
}  // namespace hexwright::test
