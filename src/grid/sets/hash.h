// Hashes of node sets; the same on every machine.
#pragma once

#include <vector>

#include "grid/sets/brick_set.h"

namespace hexwright::grids {

/// Based on: Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return x ^ x >> 31;
}

inline std::uint64_t hash_of(const BrickSet& set, std::uint64_t seed) {
  std::uint64_t h = mix_bits(seed + 1);
  for (const Brick& b : set.bricks()) h = mix_bits(h ^ mix_bits(b.key)) + mix_bits(b.bits);
  return h;
}

inline std::uint64_t hash_of(const std::vector<LatticeCoord>& coords) {
  std::uint64_t h = 1;
  for (const LatticeCoord& c : coords)
    for (const std::int32_t x : c) h = mix_bits(h ^ static_cast<std::uint32_t>(x));
  return h;
}

}  // namespace hexwright::grids
