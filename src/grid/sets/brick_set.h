// A set of lattice nodes of one depth: non-empty bricks sorted by key, with constant-time lookup.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "grid/sets/brick.h"

namespace hexwright::grids {

class BrickSet {
 public:
  static constexpr std::uint32_t kAbsent = 0xffffffff;

  BrickSet() = default;
  /// From bricks in any order; bricks with equal keys are united, empty ones dropped.
  explicit BrickSet(std::vector<Brick> bricks);

  std::span<const Brick> bricks() const { return bricks_; }
  std::size_t num_bricks() const { return bricks_.size(); }
  bool empty() const { return bricks_.empty(); }
  std::size_t num_nodes() const;

  /// Position of the brick in bricks(), or kAbsent.
  std::uint32_t find(BrickKey key) const {
    if (slots_.empty()) return kAbsent;
    for (std::size_t s = home_slot(key);; s = (s + 1) & (slots_.size() - 1)) {
      const std::uint32_t i = slots_[s];
      if (i == kAbsent || bricks_[i].key == key) return i;
    }
  }
  BrickBits bits(BrickKey key) const {
    const std::uint32_t i = find(key);
    return i == kAbsent ? 0 : bricks_[i].bits;
  }
  bool contains(const LatticeCoord& node) const {
    return bits(brick_of_node(node)) >> bit_of_node(node) & 1;
  }
  /// Words of the 27 bricks around one, by neighbour number.
  std::array<BrickBits, 27> neighbourhood(BrickKey key) const {
    std::array<BrickBits, 27> words;
    const auto keys = neighbour_keys(key);
    for (int n = 0; n < 27; ++n) words[n] = bits(keys[n]);
    return words;
  }

  friend bool operator==(const BrickSet& a, const BrickSet& b) { return a.bricks_ == b.bricks_; }

 private:
  std::size_t home_slot(BrickKey key) const {
    return static_cast<std::size_t>(key * 0x9e3779b97f4a7c15u >> slot_shift_);
  }
  void build_slots();

  std::vector<Brick> bricks_;
  std::vector<std::uint32_t> slots_;  ///< open addressing, a power of two of them
  int slot_shift_ = 63;
};

/// Collects words emitted by the chunks of a parallel loop, each chunk into its own list, so that
/// the union does not depend on threads.
class BrickCollector {
 public:
  explicit BrickCollector(std::size_t num_chunks) : lists_(num_chunks) {}
  std::vector<Brick>& list(std::size_t chunk) { return lists_[chunk]; }
  /// All bricks united; the collector is empty afterwards.
  BrickSet take();

 private:
  std::vector<std::vector<Brick>> lists_;
};

/// Sorts by key and unites bricks of equal key in place.
void normalize_bricks(std::vector<Brick>& bricks);

}  // namespace hexwright::grids
