// Morton order inside a root cube: the bits of x, y and z interleaved, x lowest.
//
// A key holds 3 x kMaxGridLevel = 60 bits. The eight children of a node have consecutive keys
// 8k .. 8k+7, child number = x + 2y + 4z.
#pragma once

#include <cstdint>

#include "hexwright/grid/grid.h"

namespace hexwright::grids {

using MortonKey = std::uint64_t;

/// Spreads the low 21 bits of `v` so that bit b lands at 3b.
constexpr MortonKey spread_bits(std::uint32_t v) {
  MortonKey x = v & 0x1fffff;
  x = (x | x << 32) & 0x001f00000000ffff;
  x = (x | x << 16) & 0x001f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  x = (x | x << 2) & 0x1249249249249249;
  return x;
}

/// Inverse of spread_bits.
constexpr std::uint32_t gather_bits(MortonKey x) {
  x &= 0x1249249249249249;
  x = (x ^ x >> 2) & 0x10c30c30c30c30c3;
  x = (x ^ x >> 4) & 0x100f00f00f00f00f;
  x = (x ^ x >> 8) & 0x001f0000ff0000ff;
  x = (x ^ x >> 16) & 0x001f00000000ffff;
  x = (x ^ x >> 32) & 0x1fffff;
  return static_cast<std::uint32_t>(x);
}

/// Key of a node from its position inside the root; coordinates below 2^20.
constexpr MortonKey morton_encode(std::int32_t x, std::int32_t y, std::int32_t z) {
  return spread_bits(static_cast<std::uint32_t>(x)) |
         spread_bits(static_cast<std::uint32_t>(y)) << 1 |
         spread_bits(static_cast<std::uint32_t>(z)) << 2;
}

constexpr LatticeCoord morton_decode(MortonKey key) {
  return {static_cast<std::int32_t>(gather_bits(key)),
          static_cast<std::int32_t>(gather_bits(key >> 1)),
          static_cast<std::int32_t>(gather_bits(key >> 2))};
}

/// As operator==, which compilers turn into a call of memcmp.
constexpr bool is_same_coord(const LatticeCoord& a, const LatticeCoord& b) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/// Order of root cubes in Grid::roots: by z, then y, then x.
constexpr bool root_less(const LatticeCoord& a, const LatticeCoord& b) {
  return a[2] != b[2] ? a[2] < b[2] : a[1] != b[1] ? a[1] < b[1] : a[0] < b[0];
}

}  // namespace hexwright::grids
