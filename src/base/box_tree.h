// A balanced tree of boxes around the items 0 .. n-1, for "what is near here". Everything in the
// library that looks for boxes or points in space uses it, but for the triangles of a surface,
// whose rays and closest points have a wider tree of their own (geometry/tree/triangle_bvh.h).
//
// Based on: Ericson, "Real-Time Collision Detection", 2005, section 6.2 (splits at the object
// median). Differs: every range is halved, so that a node's place in the array says which items
// it holds, and nodes are boxes and nothing else.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "hexwright/base/vec3.h"

namespace hexwright {

constexpr bool do_overlap(const Box3& a, const Box3& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.lo[axis] > b.hi[axis] || b.lo[axis] > a.hi[axis]) return false;
  return true;
}

/// From a point to the nearest of the box, squared; 0 inside.
constexpr double distance_sq(const Box3& box, const Vec3& p) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double off = std::max({box.lo[axis] - p[axis], p[axis] - box.hi[axis], 0.0});
    sum += off * off;
  }
  return sum;
}

constexpr int longest_axis(const Vec3& extent) {
  if (extent.x >= extent.y && extent.x >= extent.z) return 0;
  return extent.y >= extent.z ? 1 : 2;
}

/// Moves the lower half of a range, by centres along an axis, before the upper one, which begins at
/// `middle`. `key` gives an item's centre and number: equal centres go by number, which makes the
/// halves a function of the items and not of the library's nth_element.
template <class Iterator, class Key>
void split_at_median(Iterator begin, Iterator middle, Iterator end, int axis, const Key& key) {
  std::nth_element(begin, middle, end, [&](const auto& a, const auto& b) {
    const auto [center_a, number_a] = key(a);
    const auto [center_b, number_b] = key(b);
    return center_a[axis] != center_b[axis] ? center_a[axis] < center_b[axis] : number_a < number_b;
  });
}

/// Keeps the boxes of its nodes, not those of the items. Immutable: queries from many threads at
/// once are safe. Memory: 28 to 52 bytes per item.
class BoxTree {
 public:
  using Item = std::uint32_t;

  BoxTree() = default;
  explicit BoxTree(std::span<const Box3> boxes) : order_(boxes.size()) {
    if (boxes.empty()) return;
    std::iota(order_.begin(), order_.end(), Item{0});
    std::size_t num_nodes = 1;
    for (std::size_t size = boxes.size(); size > kLeafSize; size = (size + 1) / 2)
      num_nodes = 2 * num_nodes + 1;
    nodes_.resize(num_nodes);
    build(boxes, {0, 0, static_cast<Item>(order_.size())});
  }

  /// The box around all items; empty without any.
  Box3 box() const { return nodes_.empty() ? Box3{} : nodes_[0]; }

  /// Calls `accept(item)` in an order that depends on the boxes alone, until it returns true; true
  /// when it did. Leaves out items only where `meets(box)` denied a box that holds theirs: whether
  /// an item itself meets is the caller's to say.
  template <class Meets, class Accept>
  bool find(const Meets& meets, const Accept& accept) const {
    Stack stack(order_.size());
    while (stack.size > 0) {
      const Range range = stack.pop();
      if (!meets(nodes_[range.node])) continue;
      if (range.is_leaf()) {
        for (Item i = range.begin; i < range.end; ++i)
          if (accept(order_[i])) return true;
      } else {
        stack.push(range.upper());
        stack.push(range.lower());
      }
    }
    return false;
  }

  /// Calls `visit(item)` for all of them.
  template <class Meets, class Visit>
  void visit(const Meets& meets, const Visit& visit) const {
    find(meets, [&](Item item) {
      visit(item);
      return false;
    });
  }

  /// Calls `consider(item)` for items whose box may be near p, nearer ones first as far as boxes
  /// tell. It returns the squared distance beyond which nothing matters any more.
  template <class Consider>
  void visit_nearest(const Vec3& p, const Consider& consider) const {
    double bound = std::numeric_limits<double>::infinity();
    Stack stack(order_.size());
    while (stack.size > 0) {
      const Range range = stack.pop();
      if (distance_sq(nodes_[range.node], p) > bound) continue;
      if (range.is_leaf()) {
        for (Item i = range.begin; i < range.end; ++i) bound = consider(order_[i]);
        continue;
      }
      Range near = range.lower(), far = range.upper();
      if (distance_sq(nodes_[far.node], p) < distance_sq(nodes_[near.node], p))
        std::swap(near, far);
      stack.push(far);
      stack.push(near);
    }
  }

 private:
  // Below this the boxes cost more than the tests of items they spare.
  static constexpr std::size_t kLeafSize = 4;

  /// A node and the places in order_ of what it holds; the lower half is the larger one.
  struct Range {
    Item node, begin, end;
    Item middle() const { return begin + (end - begin + 1) / 2; }
    bool is_leaf() const { return end - begin <= kLeafSize; }
    Range lower() const { return {2 * node + 1, begin, middle()}; }
    Range upper() const { return {2 * node + 2, middle(), end}; }
  };

  /// Depth is at most log2(size) + 1, and each level leaves one range behind.
  struct Stack {
    explicit Stack(std::size_t num_items) {
      if (num_items > 0) push({0, 0, static_cast<Item>(num_items)});
    }
    void push(const Range& range) { ranges[size++] = range; }
    Range pop() { return ranges[--size]; }
    std::array<Range, 40> ranges;
    std::size_t size = 0;
  };

  void build(std::span<const Box3> boxes, const Range& range) {
    Box3 box, centers;
    for (Item i = range.begin; i < range.end; ++i) {
      box.extend(boxes[order_[i]]);
      centers.extend(boxes[order_[i]].center());
    }
    nodes_[range.node] = box;
    if (range.is_leaf()) return;
    const auto at = [&](Item i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    split_at_median(at(range.begin), at(range.middle()), at(range.end),
                    longest_axis(centers.extent()),
                    [&](Item item) { return std::pair(boxes[item].center(), item); });
    build(boxes, range.lower());
    build(boxes, range.upper());
  }

  std::vector<Item> order_;
  std::vector<Box3> nodes_;  // of node n; its halves are 2n+1 and 2n+2
};

}  // namespace hexwright
