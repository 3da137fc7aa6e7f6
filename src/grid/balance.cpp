// Balance in one sweep: each depth's requirements on the one above.
//
// Based on: docs/algorithms/pairing.md, rule (B).
#include "grid/balance.h"

#include "hexwright/base/parallel.h"

namespace hexwright {
namespace {

constexpr std::size_t kBricksPerChunk = 2048;

/// Adds a word to a list whose last entry may already be the same brick.
void append(std::vector<Brick>& bricks, BrickKey key, BrickBits bits) {
  if (!bricks.empty() && bricks.back().key == key)
    bricks.back().bits |= bits;
  else
    bricks.push_back({key, bits});
}

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
      const auto grown = grow_by_neighbours(bricks[i].bits, balance);
      const auto keys = neighbour_keys(bricks[i].key);
      for (int n = 0; n < 27; ++n) {
        // Above depth 2 a brick spans several roots, and even its own nodes may not exist.
        const bool may_leave_domain = n != 13 || depth < 2;
        const BrickBits w =
            grown[n] && may_leave_domain ? grown[n] & domain.mask(keys[n], depth) : grown[n];
        if (w) append(list, keys[n] >> 3, parent_bits(keys[n], w));
      }
    }
    normalize_bricks(list);
  });
  collector.list(num_chunks).assign(input.bricks().begin(), input.bricks().end());
  return collector.take();
}

}  // namespace hexwright
