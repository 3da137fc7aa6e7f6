// Balance in one sweep: each depth's requirements on the one above.
//
// Based on: docs/algorithms/pairing.md, rule (B).
#include "grid/pairing/balance.h"

#include "hexwright/base/parallel.h"

namespace hexwright::grids {
namespace {

constexpr std::size_t kBricksPerChunk = 256;

/// Face neighbours: own moves by one along each axis, not one after the other as that would reach
/// across edges.
std::array<BrickBits, 27> grow_weak(BrickBits w) {
  std::array<BrickBits, 27> out{};
  BrickBits own = w;
  for (int a = 0; a < 3; ++a) {
    own |= shift_up(w, a) | shift_down(w, a);
    const int step = a == 0 ? 1 : a == 1 ? 3 : 9;
    out[13 + step] = move_slice(w, a, 3, 0);
    out[13 - step] = move_slice(w, a, 0, 3);
  }
  out[13] = own;
  return out;
}

/// All 26 neighbours: the axes after each other, each spreading what the last one reached.
std::array<BrickBits, 27> grow_strong(BrickBits w) {
  std::array<BrickBits, 27> out{};
  for (int dx = -1; dx <= 1; ++dx) {
    const BrickBits x = spread_axis(w, 0, Spread::One, dx);
    if (x == 0) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      const BrickBits y = spread_axis(x, 1, Spread::One, dy);
      for (int dz = -1; dz <= 1; ++dz)
        out[neighbour_number(dx, dy, dz)] = spread_axis(y, 2, Spread::One, dz);
    }
  }
  return out;
}

/// Along each axis a brick's parent has an even and an odd half. The neighbours of a brick in the
/// even half reach the parent below it, the others the one above: eight parents in all.
constexpr int parent_slot(BrickKey key, int neighbour) {
  int slot = 0;
  for (int a = 0; a < 3; ++a) {
    const int side = (a == 0 ? neighbour % 3 : a == 1 ? neighbour / 3 % 3 : neighbour / 9) - 1;
    const bool is_odd = key >> a & 1;
    if (side == (is_odd ? 1 : -1)) slot |= 1 << a;
  }
  return slot;
}

/// The parents of a brick's nodes and of their neighbours, as far as those exist: one word per
/// brick of the depth above that they can lie in.
std::array<Brick, 8> parents_of_grown(const Brick& brick, int depth, Balance balance,
                                      const LatticeDomain& domain) {
  std::array<Brick, 8> parents{};
  const auto grown = grow_by_neighbours(brick.bits, balance);
  const auto keys = neighbour_keys(brick.key);
  for (int n = 0; n < 27; ++n) {
    if (grown[n] == 0) continue;
    const BrickBits w = grown[n] & domain.neighbour_mask(brick.key, keys[n], depth);
    if (w == 0) continue;
    Brick& parent = parents[parent_slot(brick.key, n)];
    parent.key = keys[n] >> 3;
    parent.bits |= parent_bits(keys[n], w);
  }
  return parents;
}

}  // namespace

std::array<BrickBits, 27> grow_by_neighbours(BrickBits w, Balance balance) {
  switch (balance) {
    case Balance::Weak:
      return grow_weak(w);
    case Balance::Strong:
      return grow_strong(w);
    default:
      break;  // Relaxed: one depth above needs the parents alone
  }
  std::array<BrickBits, 27> own{};
  own[13] = w;
  return own;
}

BrickSet required_two_above(const BrickSet& split, int depth, const LatticeDomain& domain,
                            const BrickSet& input) {
  const BrickSet halo = required_above(split, depth, Balance::Strong, domain, BrickSet());
  return required_above(halo, depth - 1, Balance::Relaxed, domain, input);
}

BrickSet required_above(const BrickSet& split, int depth, Balance balance,
                        const LatticeDomain& domain, const BrickSet& input) {
  const auto bricks = split.bricks();
  const std::size_t num_chunks = (bricks.size() + kBricksPerChunk - 1) / kBricksPerChunk;
  BrickCollector collector(num_chunks + 1);
  parallel_chunks(bricks.size(), kBricksPerChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<Brick>& list = collector.list(begin / kBricksPerChunk);
    for (std::size_t i = begin; i < end; ++i) {
      const auto parents = parents_of_grown(bricks[i], depth, balance, domain);
      for (const Brick& parent : parents)
        if (parent.bits) list.push_back(parent);
    }
    normalize_bricks(list);
  });
  collector.list(num_chunks).assign(input.bricks().begin(), input.bricks().end());
  return collector.take();
}

}  // namespace hexwright::grids
