// Bricks: 4x4x4 lattice nodes as one 64-bit word, the unit of work of balance and pairing.
//
// Bit x + 4y + 16z of a word is node (x, y, z) of its brick, 0 <= x, y, z < 4. A brick's key is the
// Morton key (21 bits per axis) of its position; the eight bricks of the next depth inside brick k
// have keys 8k .. 8k+7. Node coordinates here are never negative: see LatticeDomain.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "grid/cells/morton.h"

namespace hexwright::grids {

using BrickBits = std::uint64_t;
using BrickKey = MortonKey;

/// Largest node coordinate + 1 that bricks can address.
inline constexpr std::int64_t kMaxNodeCoord = std::int64_t{1} << 23;

struct Brick {
  BrickKey key = 0;
  BrickBits bits = 0;
  friend bool operator==(const Brick&, const Brick&) = default;
};

/// Bits of a word whose coordinate along an axis is 0; shift by c * kAxisStep for coordinate c.
inline constexpr std::array<BrickBits, 3> kAxisSlice = {0x1111111111111111, 0x000f000f000f000f,
                                                        0x000000000000ffff};
inline constexpr std::array<int, 3> kAxisStep = {1, 4, 16};

/// Number of nodes in a word. Without the processor's own instruction, which a portable build may
/// not use, std::popcount is a call.
constexpr int count_bits(BrickBits w) {
  w -= w >> 1 & 0x5555555555555555;
  w = (w & 0x3333333333333333) + (w >> 2 & 0x3333333333333333);
  w = (w + (w >> 4)) & 0x0f0f0f0f0f0f0f0f;
  return static_cast<int>(w * 0x0101010101010101 >> 56);
}

constexpr BrickKey brick_key(const LatticeCoord& brick) {
  return morton_encode(brick[0], brick[1], brick[2]);
}
/// Key of the brick that holds a node.
constexpr BrickKey brick_of_node(const LatticeCoord& node) {
  return morton_encode(node[0] >> 2, node[1] >> 2, node[2] >> 2);
}
constexpr int bit_of_node(const LatticeCoord& node) {
  return (node[0] & 3) + 4 * (node[1] & 3) + 16 * (node[2] & 3);
}
constexpr LatticeCoord node_of_bit(BrickKey key, int bit) {
  const LatticeCoord b = morton_decode(key);
  return {4 * b[0] + (bit & 3), 4 * b[1] + (bit >> 2 & 3), 4 * b[2] + (bit >> 4)};
}

constexpr BrickBits slice(int axis, int coord) {
  return kAxisSlice[axis] << (coord * kAxisStep[axis]);
}
/// The bits with coordinate `from` along the axis, moved to coordinate `to`.
constexpr BrickBits move_slice(BrickBits w, int axis, int from, int to) {
  const BrickBits part = w & slice(axis, from);
  const int shift = (to - from) * kAxisStep[axis];
  return shift >= 0 ? part << shift : part >> -shift;
}
/// Every node moved by one along the axis, inside the brick; what leaves it is lost.
constexpr BrickBits shift_up(BrickBits w, int axis) {
  return (w & ~slice(axis, 3)) << kAxisStep[axis];
}
constexpr BrickBits shift_down(BrickBits w, int axis) {
  return (w & ~slice(axis, 0)) >> kAxisStep[axis];
}

/// How a set grows along one axis.
enum class Spread {
  One,       ///< by one node to both sides
  Two,       ///< by two nodes to both sides
  OddPairs,  ///< to pairs of nodes (2k, 2k+1), whose middle vertex 2k+1 is odd
  EvenPairs  ///< to pairs of nodes (2k-1, 2k), whose middle vertex 2k is even
};

/// The part of the grown word that lands in the brick at `side` = -1, 0 or +1 along the axis.
constexpr BrickBits spread_axis(BrickBits w, int axis, Spread spread, int side) {
  const auto move = [&](int from, int to) { return move_slice(w, axis, from, to); };
  if (side == 0) {
    switch (spread) {
      case Spread::One:
        return w | shift_up(w, axis) | shift_down(w, axis);
      case Spread::Two: {
        const BrickBits one = w | shift_up(w, axis) | shift_down(w, axis);
        return one | shift_up(one, axis) | shift_down(one, axis);
      }
      case Spread::OddPairs:
        return w | move(0, 1) | move(1, 0) | move(2, 3) | move(3, 2);
      case Spread::EvenPairs:
        return w | move(1, 2) | move(2, 1);
    }
  }
  switch (spread) {
    case Spread::One:
    case Spread::EvenPairs:
      return side > 0 ? move(3, 0) : move(0, 3);
    case Spread::Two:
      return side > 0 ? move(3, 0) | move(3, 1) | move(2, 0) : move(0, 3) | move(0, 2) | move(1, 3);
    case Spread::OddPairs:
      return 0;
  }
  return 0;
}

/// The parents of a brick's nodes: their bits in the brick that holds them, which is `key >> 3`.
constexpr BrickBits parent_bits(BrickKey key, BrickBits w) {
  w |= w >> 1;
  w |= w >> 4;
  w |= w >> 16;
  w &= 0x0000050500000505;                 // x, y, z in {0, 2}
  w = (w | w >> 1) & 0x0000030300000303;   // x to 0, 1
  w = (w | w >> 4) & 0x0000003300000033;   // y
  w = (w | w >> 16) & 0x0000000000330033;  // z
  const int octant = static_cast<int>(key & 7);
  return w << ((octant & 1) * 2 + (octant >> 1 & 1) * 8 + (octant >> 2) * 32);
}

/// The eight children of bit `parent_bit` of brick `key >> 3`, as a word with bit x + 2y + 4z, from
/// the word of the brick `key` of the next depth that holds them.
constexpr unsigned child_octet(BrickBits w, int parent_bit) {
  const int px = parent_bit & 1, py = parent_bit >> 2 & 1, pz = parent_bit >> 4 & 1;
  w >>= 2 * px + 8 * py + 32 * pz;
  return static_cast<unsigned>((w & 3) | (w >> 2 & 0xc) | (w >> 12 & 0x30) | (w >> 14 & 0xc0));
}

/// Number of a neighbouring brick: (dx+1) + 3 (dy+1) + 9 (dz+1); 13 is the brick itself.
constexpr int neighbour_number(int dx, int dy, int dz) {
  return dx + 1 + 3 * (dy + 1) + 9 * (dz + 1);
}

/// Keys of a brick's 27 neighbours (itself included), by neighbour number.
constexpr std::array<BrickKey, 27> neighbour_keys(BrickKey key) {
  constexpr BrickKey kX = 0x1249249249249249;
  std::array<std::array<BrickKey, 3>, 3> part{};
  for (int a = 0; a < 3; ++a) {
    const BrickKey mask = kX << a;
    const BrickKey own = key & mask;
    part[a] = {(own - (BrickKey{1} << a)) & mask, own, ((own | ~mask) + 1) & mask};
  }
  std::array<BrickKey, 27> keys{};
  for (int n = 0; n < 27; ++n) keys[n] = part[0][n % 3] | part[1][n / 3 % 3] | part[2][n / 9];
  return keys;
}

}  // namespace hexwright::grids
