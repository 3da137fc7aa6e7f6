// Sets of lattice nodes as sorted bricks.
#include "grid/sets/brick_set.h"

#include <algorithm>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"

namespace hexwright::grids {
namespace {

// A lambda, not a function: sorting calls it in line.
constexpr auto kKeyLess = [](const Brick& a, const Brick& b) { return a.key < b.key; };

/// In place, for sorted bricks; empty ones go.
void unite_equal_keys(std::vector<Brick>& bricks) {
  std::size_t num_kept = 0;
  for (const Brick& b : bricks) {
    if (b.bits == 0) continue;
    if (num_kept > 0 && bricks[num_kept - 1].key == b.key)
      bricks[num_kept - 1].bits |= b.bits;
    else
      bricks[num_kept++] = b;
  }
  bricks.resize(num_kept);
}

}  // namespace

void normalize_bricks(std::vector<Brick>& bricks) {
  if (!std::is_sorted(bricks.begin(), bricks.end(), kKeyLess))
    parallel_stable_sort(bricks.begin(), bricks.end(), kKeyLess);
  unite_equal_keys(bricks);
}

BrickSet::BrickSet(std::vector<Brick> bricks) : bricks_(std::move(bricks)) {
  normalize_bricks(bricks_);
  // Sets live long, several per depth: what the union saved is worth giving back.
  bricks_.shrink_to_fit();
  if (bricks_.size() >= kAbsent / 4)
    throw Error(ErrorCode::OutOfResources, "the grid has too many split nodes in one level");
  build_slots();
}

std::size_t BrickSet::num_nodes() const {
  std::size_t count = 0;
  for (const Brick& b : bricks_) count += static_cast<std::size_t>(count_bits(b.bits));
  return count;
}

void BrickSet::build_slots() {
  if (bricks_.empty()) return;
  // At most half full, so that a miss, the commonest question, ends after one or two slots.
  const std::size_t num_slots = std::bit_ceil(2 * bricks_.size());
  slot_shift_ = 64 - std::countr_zero(num_slots);
  slots_.assign(num_slots, kAbsent);
  for (std::uint32_t i = 0; i < bricks_.size(); ++i) {
    std::size_t s = home_slot(bricks_[i].key);
    while (slots_[s] != kAbsent) s = (s + 1) & (num_slots - 1);
    slots_[s] = i;
  }
}

// Each list is sorted by itself in parallel; joined in the order of chunks they are nearly sorted,
// and the union of equal keys makes the result the same however the words were spread.
BrickSet BrickCollector::take() {
  parallel_for(
      lists_.size(), [&](std::size_t i) { normalize_bricks(lists_[i]); }, 1);
  std::size_t total = 0;
  for (const auto& list : lists_) total += list.size();
  std::vector<Brick> all;
  all.reserve(total);
  for (auto& list : lists_) {
    all.insert(all.end(), list.begin(), list.end());
    std::vector<Brick>().swap(list);
  }
  return BrickSet(std::move(all));
}

}  // namespace hexwright::grids
