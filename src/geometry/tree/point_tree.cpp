// An implicit k-d tree: the median of each range of `order_` splits it, so only the axis is stored.
//
// Based on: Bentley, "Multidimensional binary search trees used for associative searching", CACM
// 18(9), 1975.
#include "geometry/tree/point_tree.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace hexwright {
namespace {

constexpr std::size_t kLeafSize = 8;

int longest_axis(const Vec3& extent) {
  const int axis = extent.x >= extent.y ? 0 : 1;
  return extent[axis] >= extent.z ? axis : 2;
}

}  // namespace

PointTree::PointTree(std::vector<Vec3> points)
    : points_(std::move(points)), order_(points_.size()), axis_(points_.size(), 0) {
  std::iota(order_.begin(), order_.end(), std::uint32_t{0});
  build(0, points_.size());
}

// Equal coordinates go by index, which makes the order a function of the points and not of the
// library's nth_element. Points on the split plane may be on both sides of it.
void PointTree::build(std::size_t begin, std::size_t end) {
  if (end - begin <= kLeafSize) return;
  Box3 box;
  for (std::size_t i = begin; i < end; ++i) box.extend(points_[order_[i]]);
  const int axis = longest_axis(box.extent());
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
    return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
  });
  axis_[middle] = static_cast<std::uint8_t>(axis);
  build(begin, middle);
  build(middle + 1, end);
}

void PointTree::visit_box(const Box3& box, FunctionRef<void(std::size_t)> visit) const {
  const auto visit_if_inside = [&](std::size_t i) {
    if (box.contains(points_[order_[i]])) visit(order_[i]);
  };
  // Depth is at most log2(size) + 1, and each level leaves one range behind.
  std::array<std::array<std::size_t, 2>, 64> stack;
  std::size_t size = 0;
  stack[size++] = {0, points_.size()};
  while (size > 0) {
    const auto [begin, end] = stack[--size];
    if (end - begin <= kLeafSize) {
      for (std::size_t i = begin; i < end; ++i) visit_if_inside(i);
      continue;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const int axis = axis_[middle];
    const double split = points_[order_[middle]][axis];
    visit_if_inside(middle);
    if (box.hi[axis] >= split) stack[size++] = {middle + 1, end};
    if (box.lo[axis] <= split) stack[size++] = {begin, middle};
  }
}

}  // namespace hexwright
