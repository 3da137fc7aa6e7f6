// What a depth requires of the one above, and blocks of one parity, against their definitions.
#include "grid/pairing/balance.h"

#include <gtest/gtest.h>

#include "grid/grid_helpers.h"
#include "grid/pairing/blocks.h"
#include "grid/plain_sets.h"

namespace hexwright {

using namespace grids;

namespace {

using test::bricks_of;
using test::plain;
using test::PlainSet;
using test::Roots;
using test::sample_domains;

/// Nodes of a depth that exist in the domain, each with the given probability.
PlainSet random_domain_nodes(std::mt19937& rng, const LatticeDomain& domain, int depth,
                             double share) {
  PlainSet out;
  for (const LatticeCoord& root : domain.shifted_roots())
    for (const LatticeCoord& n : test::random_nodes(
             rng, {root[0] << depth, root[1] << depth, root[2] << depth}, 1 << depth, share))
      out.insert(n);
  return out;
}

bool is_neighbour_offset(int q, Balance balance) {
  const int steps = (q % 3 != 1) + (q / 3 % 3 != 1) + (q / 9 != 1);
  return balance == Balance::Strong || steps <= (balance == Balance::Weak ? 1 : 0);
}

/// Rule (B) node by node.
PlainSet required_slowly(const PlainSet& split, int depth, Balance balance,
                         const LatticeDomain& domain, const PlainSet& input) {
  PlainSet out = input;
  for (const LatticeCoord& n : split)
    for (int q = 0; q < 27; ++q) {
      const LatticeCoord m = {n[0] + q % 3 - 1, n[1] + q / 3 % 3 - 1, n[2] + q / 9 - 1};
      if (is_neighbour_offset(q, balance) && domain.contains(m, depth))
        out.insert({m[0] >> 1, m[1] >> 1, m[2] >> 1});
    }
  return out;
}

TEST(Balance, RequiresTheParentsOfNodesAndNeighbours) {
  std::mt19937 rng(1);
  for (const Roots& roots : sample_domains())
    for (int depth = 1; depth <= 4; ++depth)
      for (const Balance balance : {Balance::Weak, Balance::Strong, Balance::Relaxed}) {
        const LatticeDomain domain(roots, depth + 1);
        const PlainSet split = random_domain_nodes(rng, domain, depth, 0.03);
        const PlainSet input = random_domain_nodes(rng, domain, depth - 1, 0.02);
        const BrickSet found =
            required_above(bricks_of(split), depth, balance, domain, bricks_of(input));
        EXPECT_EQ(plain(found), required_slowly(split, depth, balance, domain, input))
            << "depth " << depth;
      }
}

TEST(Balance, RelaxedLooksTwoDepthsUp) {
  std::mt19937 rng(2);
  for (const Roots& roots : sample_domains())
    for (int depth = 2; depth <= 4; ++depth) {
      const LatticeDomain domain(roots, depth + 1);
      const PlainSet split = random_domain_nodes(rng, domain, depth, 0.03);
      const PlainSet input = random_domain_nodes(rng, domain, depth - 2, 0.02);
      const PlainSet halo = required_slowly(split, depth, Balance::Strong, domain, {});
      const PlainSet expected = required_slowly(halo, depth - 1, Balance::Relaxed, domain, input);
      EXPECT_EQ(plain(required_two_above(bricks_of(split), depth, domain, bricks_of(input))),
                expected);
    }
}

TEST(Balance, RequirementsOfAUnionAreTheUnionOfRequirements) {
  std::mt19937 rng(3);
  const LatticeDomain domain({{0, 0, 0}, {1, 0, 0}}, 5);
  for (int k = 0; k < 10; ++k) {
    const PlainSet a = random_domain_nodes(rng, domain, 4, 0.01);
    const PlainSet b = random_domain_nodes(rng, domain, 4, 0.01);
    PlainSet both = a;
    both.insert(b.begin(), b.end());
    const auto required = [&](const PlainSet& s) {
      return plain(required_above(bricks_of(s), 4, Balance::Weak, domain, BrickSet()));
    };
    PlainSet expected = required(a);
    for (const LatticeCoord& n : required(b)) expected.insert(n);
    EXPECT_EQ(required(both), expected);
  }
}

TEST(Blocks, CoverEveryNodeByItsBlockOfThatParity) {
  std::mt19937 rng(4);
  for (const Roots& roots : sample_domains())
    for (int depth = 0; depth <= 3; ++depth)
      for (Parity p = 0; p < kNumParities; ++p) {
        const LatticeDomain domain(roots, depth + 1);
        const PlainSet required = random_domain_nodes(rng, domain, depth, 0.05);
        PlainSet expected;
        for (const LatticeCoord& n : required) {
          const LatticeCoord v = block_center(n, p);
          for (int q = 0; q < 8; ++q) {
            const LatticeCoord m = {v[0] - (q & 1), v[1] - (q >> 1 & 1), v[2] - (q >> 2)};
            if (domain.contains(m, depth)) expected.insert(m);
          }
        }
        EXPECT_EQ(plain(blocks_of_parity(bricks_of(required), p, depth, domain)), expected)
            << "parity " << p << " depth " << depth;
      }
}

TEST(LatticeDomain, MasksAgreeWithItsNodes) {
  for (const Roots& roots : sample_domains())
    for (int depth = 0; depth <= 4; ++depth) {
      const LatticeDomain domain(roots, depth);
      for (const LatticeCoord& root : domain.shifted_roots()) {
        const BrickKey own = brick_of_node({root[0] << depth, root[1] << depth, root[2] << depth});
        bool is_interior = true;
        for (const BrickKey other : neighbour_keys(own)) {
          const BrickBits mask = domain.mask(other, depth);
          EXPECT_EQ(domain.neighbour_mask(own, other, depth), mask);
          for (int bit = 0; bit < 64; ++bit)
            EXPECT_EQ(mask >> bit & 1, domain.contains(node_of_bit(other, bit), depth));
          is_interior = is_interior && mask == ~BrickBits{0};
        }
        EXPECT_EQ(domain.is_interior(own, depth), is_interior);
      }
    }
}

}  // namespace
}  // namespace hexwright
