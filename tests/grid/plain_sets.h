// Brick sets beside plain sets of nodes, for tests against the definitions.
#pragma once

#include <random>
#include <set>

#include "grid/sets/brick_set.h"

namespace hexwright::test {

using namespace grids;

using PlainSet = std::set<LatticeCoord>;

inline PlainSet plain(const BrickSet& set) {
  PlainSet out;
  for (const Brick& b : set.bricks())
    for (int bit = 0; bit < 64; ++bit)
      if (b.bits >> bit & 1) out.insert(node_of_bit(b.key, bit));
  return out;
}

inline BrickSet bricks_of(const PlainSet& nodes) {
  std::vector<Brick> bricks;
  for (const LatticeCoord& n : nodes)
    bricks.push_back({brick_of_node(n), BrickBits{1} << bit_of_node(n)});
  return BrickSet(std::move(bricks));
}

/// Nodes of a box, each with the given probability.
inline PlainSet random_nodes(std::mt19937& rng, const LatticeCoord& low, int edge, double share) {
  std::uniform_real_distribution<> uniform(0, 1);
  PlainSet out;
  for (int q = 0; q < edge * edge * edge; ++q)
    if (uniform(rng) < share)
      out.insert({low[0] + q % edge, low[1] + q / edge % edge, low[2] + q / edge / edge});
  return out;
}

}  // namespace hexwright::test
