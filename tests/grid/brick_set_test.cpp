// Words of 4x4x4 nodes and sets of them, against plain sets of nodes.
#include "grid/sets/brick_set.h"

#include <gtest/gtest.h>

#include "hexwright/base/parallel.h"

#include "grid/plain_sets.h"

namespace hexwright {

using namespace grids;

namespace {

using test::bricks_of;
using test::plain;
using test::PlainSet;
using test::random_nodes;

/// Node of a bit of the brick that lies `side` bricks from the brick at (1, 1, 1).
LatticeCoord node_at(const LatticeCoord& side, int bit) {
  return {4 + 4 * side[0] + (bit & 3), 4 + 4 * side[1] + (bit >> 2 & 3),
          4 + 4 * side[2] + (bit >> 4)};
}

TEST(Brick, BitsAndNodesAreInverse) {
  std::mt19937 rng(1);
  for (int k = 0; k < 1000; ++k) {
    const LatticeCoord node = {std::int32_t(rng() % kMaxNodeCoord),
                               std::int32_t(rng() % kMaxNodeCoord),
                               std::int32_t(rng() % kMaxNodeCoord)};
    EXPECT_EQ(node_of_bit(brick_of_node(node), bit_of_node(node)), node);
  }
}

TEST(Brick, CountsBits) {
  std::mt19937_64 rng(2);
  EXPECT_EQ(count_bits(0), 0);
  EXPECT_EQ(count_bits(~BrickBits{0}), 64);
  for (int k = 0; k < 1000; ++k) {
    const BrickBits w = rng() & rng();
    EXPECT_EQ(count_bits(w), std::popcount(w));
  }
}

TEST(Brick, NeighbourKeysAreThoseOfTheNeighbours) {
  std::mt19937 rng(3);
  for (int k = 0; k < 200; ++k) {
    LatticeCoord b;
    for (auto& x : b) x = std::int32_t(1 + rng() % 100'000);
    const auto keys = neighbour_keys(brick_key(b));
    for (int n = 0; n < 27; ++n) {
      const LatticeCoord other = {b[0] + n % 3 - 1, b[1] + n / 3 % 3 - 1, b[2] + n / 9 - 1};
      EXPECT_EQ(keys[n], brick_key(other));
      EXPECT_EQ(neighbour_number(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1), n);
    }
  }
}

/// Coordinates that a node at x spreads to along one axis.
std::set<std::int32_t> spread_of(std::int32_t x, Spread spread) {
  switch (spread) {
    case Spread::One:
      return {x - 1, x, x + 1};
    case Spread::Two:
      return {x - 2, x - 1, x, x + 1, x + 2};
    case Spread::OddPairs:
      return {x, x ^ 1};
    case Spread::EvenPairs:
      return {x, ((x + 1) ^ 1) - 1};
  }
  return {};
}

TEST(Brick, SpreadReachesExactlyTheNodesOfItsDefinition) {
  std::mt19937_64 rng(4);
  for (const Spread spread : {Spread::One, Spread::Two, Spread::OddPairs, Spread::EvenPairs})
    for (int k = 0; k < 60; ++k) {
      const int axis = k % 3;
      const BrickBits w = rng() & rng() & rng();
      PlainSet expected, found;
      for (int bit = 0; bit < 64; ++bit) {
        if (!(w >> bit & 1)) continue;
        LatticeCoord node = node_at({0, 0, 0}, bit);
        for (const std::int32_t x : spread_of(node[axis], spread)) {
          node[axis] = x;
          expected.insert(node);
        }
      }
      for (int side = -1; side <= 1; ++side) {
        LatticeCoord at = {0, 0, 0};
        at[axis] = side;
        const BrickBits part = spread_axis(w, axis, spread, side);
        for (int bit = 0; bit < 64; ++bit)
          if (part >> bit & 1) found.insert(node_at(at, bit));
      }
      EXPECT_EQ(found, expected) << "axis " << axis;
    }
}

TEST(Brick, ParentsAndChildrenAgreeWithHalvedCoordinates) {
  std::mt19937_64 rng(5);
  for (int k = 0; k < 200; ++k) {
    const BrickKey key = rng() % 4096;
    const BrickBits w = rng() & rng() & rng();
    PlainSet expected, found;
    for (int bit = 0; bit < 64; ++bit) {
      const LatticeCoord n = node_of_bit(key, bit);
      if (w >> bit & 1) expected.insert({n[0] >> 1, n[1] >> 1, n[2] >> 1});
    }
    const BrickBits parents = parent_bits(key, w);
    for (int bit = 0; bit < 64; ++bit) {
      if (!(parents >> bit & 1)) continue;
      const LatticeCoord parent = node_of_bit(key >> 3, bit);
      found.insert(parent);
      const unsigned octet = child_octet(w, bit);
      for (int q = 0; q < 8; ++q) {
        const LatticeCoord child = {2 * parent[0] + (q & 1), 2 * parent[1] + (q >> 1 & 1),
                                    2 * parent[2] + (q >> 2)};
        EXPECT_EQ(octet >> q & 1, w >> bit_of_node(child) & 1);
      }
    }
    EXPECT_EQ(found, expected);
  }
}

TEST(BrickSet, HoldsTheNodesItWasMadeOf) {
  std::mt19937 rng(6);
  for (const double share : {0.0, 0.01, 0.2, 0.9}) {
    const PlainSet nodes = random_nodes(rng, {3, 5, 2}, 14, share);
    const BrickSet set = bricks_of(nodes);
    EXPECT_EQ(plain(set), nodes);
    EXPECT_EQ(set.num_nodes(), nodes.size());
    EXPECT_EQ(set.empty(), nodes.empty());
    for (int q = 0; q < 20 * 20 * 20; ++q) {
      const LatticeCoord n = {q % 20, q / 20 % 20, q / 400};
      EXPECT_EQ(set.contains(n), nodes.count(n) != 0);
    }
  }
}

TEST(BrickSet, UnitesEqualKeysAndDropsEmptyBricks) {
  const BrickSet set({{7, 1}, {3, 0}, {7, 6}, {2, 8}, {7, 1}});
  const std::vector<Brick> expected = {{2, 8}, {7, 7}};
  EXPECT_TRUE(
      std::equal(set.bricks().begin(), set.bricks().end(), expected.begin(), expected.end()));
  EXPECT_EQ(set.find(3), BrickSet::kAbsent);
  EXPECT_EQ(set.find(7), 1u);
  EXPECT_EQ(BrickSet().find(7), BrickSet::kAbsent);
}

TEST(BrickSet, NeighbourhoodGathersTheWordsAround) {
  std::mt19937 rng(7);
  const BrickSet set = bricks_of(random_nodes(rng, {4, 4, 4}, 24, 0.05));
  for (const Brick& b : set.bricks()) {
    const auto words = set.neighbourhood(b.key);
    const auto keys = neighbour_keys(b.key);
    EXPECT_EQ(words[13], b.bits);
    for (int n = 0; n < 27; ++n) EXPECT_EQ(words[n], set.bits(keys[n]));
  }
}

TEST(BrickCollector, UnionDoesNotDependOnHowTheWordsAreSpread) {
  std::mt19937_64 rng(8);
  std::vector<Brick> words(5000);
  for (Brick& b : words) b = {rng() % 700, rng() & rng()};
  const BrickSet expected(words);
  for (const std::size_t num_lists : {1u, 3u, 64u}) {
    BrickCollector collector(num_lists);
    for (std::size_t i = 0; i < words.size(); ++i)
      collector.list(rng() % num_lists).push_back(words[i]);
    EXPECT_EQ(collector.take(), expected);
  }
}

}  // namespace
}  // namespace hexwright
