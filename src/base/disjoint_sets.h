// Disjoint sets over 0 .. size-1, by union with path halving.
//
// Based on: Tarjan, van Leeuwen, "Worst-case analysis of set union algorithms", Journal of the ACM
// 31(2), 1984. Differs: the least member represents its set instead of the root of the higher tree,
// so that numbers given to sets depend on what is in them, and not on the order of the unions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace hexwright {

/// Index: an integer type wide enough for the members.
template <class Index>
class BasicDisjointSets {
 public:
  explicit BasicDisjointSets(std::size_t size) : parent_(size), count_(size) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }

  /// A new member, alone in its set; returns its number.
  Index add() {
    parent_.push_back(static_cast<Index>(parent_.size()));
    ++count_;
    return parent_.back();
  }
  void clear() {
    parent_.clear();
    count_ = 0;
  }

  /// The least member of i's set. Shortens paths, hence not const.
  Index find(Index i) {
    while (at(i) != i) i = at(i) = at(at(i));
    return i;
  }
  void unite(Index a, Index b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    at(std::max(a, b)) = std::min(a, b);
    --count_;
  }
  /// How many sets there are.
  std::size_t count() const { return count_; }

 private:
  Index& at(Index i) { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<Index> parent_;
  std::size_t count_;
};

using DisjointSets = BasicDisjointSets<std::size_t>;

}  // namespace hexwright
