// Grows required nodes to 2x2x2 blocks.
#include "grid/pairing/blocks.h"

#include "hexwright/base/parallel.h"

namespace hexwright::grids {
namespace {

constexpr std::size_t kBricksPerChunk = 256;

/// Adds the blocks of one parity around a brick's nodes. Blocks reach into neighbouring bricks, so
/// words of one key come from several bricks and are united later.
void emit_blocks(BrickKey key, BrickBits bits, Parity parity, int depth,
                 const LatticeDomain& domain, std::vector<Brick>& out) {
  const auto grown = grow_to_blocks(bits, parity);
  const auto keys = neighbour_keys(key);
  for (int n = 0; n < 27; ++n) {
    if (grown[n] == 0) continue;
    const BrickBits w = grown[n] & domain.neighbour_mask(key, keys[n], depth);
    if (w == 0) continue;
    if (!out.empty() && out.back().key == keys[n])
      out.back().bits |= w;
    else
      out.push_back({keys[n], w});
  }
}

}  // namespace

std::array<BrickBits, 27> grow_to_blocks(BrickBits w, Parity parity) {
  std::array<BrickBits, 27> out{};
  // A block's centre is odd along an axis when it pairs nodes (2k, 2k+1), even for (2k-1, 2k); the
  // three axes are independent, so a block is three spreads after each other.
  std::array<Spread, 3> spread;
  for (int a = 0; a < 3; ++a) spread[a] = parity >> a & 1 ? Spread::OddPairs : Spread::EvenPairs;
  for (int dx = -1; dx <= 1; ++dx) {
    const BrickBits x = spread_axis(w, 0, spread[0], dx);
    if (x == 0) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      const BrickBits y = spread_axis(x, 1, spread[1], dy);
      if (y == 0) continue;
      for (int dz = -1; dz <= 1; ++dz)
        out[neighbour_number(dx, dy, dz)] = spread_axis(y, 2, spread[2], dz);
    }
  }
  return out;
}

BrickSet blocks_of(const BrickSet& required, const Clusters& clusters,
                   const std::vector<std::uint8_t>& labels, int depth,
                   const LatticeDomain& domain) {
  const std::size_t num_bricks = required.num_bricks();
  BrickCollector collector((num_bricks + kBricksPerChunk - 1) / kBricksPerChunk);
  parallel_chunks(num_bricks, kBricksPerChunk, [&](std::size_t begin, std::size_t end) {
    auto& list = collector.list(begin / kBricksPerChunk);
    for (std::size_t b = begin; b < end; ++b)
      for (std::uint32_t i = clusters.brick_offset[b]; i < clusters.brick_offset[b + 1]; ++i) {
        const Piece& piece = clusters.pieces[i];
        emit_blocks(required.bricks()[b].key, piece.bits, labels[piece.cluster], depth, domain,
                    list);
      }
    normalize_bricks(list);
  });
  return collector.take();
}

BrickSet blocks_of_parity(const BrickSet& required, Parity parity, int depth,
                          const LatticeDomain& domain) {
  const std::size_t num_bricks = required.num_bricks();
  BrickCollector collector((num_bricks + kBricksPerChunk - 1) / kBricksPerChunk);
  parallel_chunks(num_bricks, kBricksPerChunk, [&](std::size_t begin, std::size_t end) {
    auto& list = collector.list(begin / kBricksPerChunk);
    for (std::size_t b = begin; b < end; ++b)
      emit_blocks(required.bricks()[b].key, required.bricks()[b].bits, parity, depth, domain, list);
    normalize_bricks(list);
  });
  return collector.take();
}

}  // namespace hexwright::grids
