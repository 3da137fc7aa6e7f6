// A tree of boxes over points in a plane, searched by triangle.
#include "io/surface/plane_tree.h"

namespace hexwright::io {
namespace {

constexpr std::size_t kLeaf = 8;  // points

/// a u + b v + c >= 0 on the inner side of an edge, a and b of unit length.
struct HalfPlane {
  double a = 0, b = 0, c = 0;
};

HalfPlane half_plane(const PlanePoint& p, const PlanePoint& q) {
  const double du = q.u - p.u, dv = q.v - p.v;
  const double length = std::sqrt(du * du + dv * dv);  // std::hypot would ask for glibc 2.35
  if (!(length > 0)) return {};  // keeps everything
  const double a = -dv / length, b = du / length;
  return {a, b, -(a * p.u + b * p.v)};
}

}  // namespace

/// The triangle as a box and three half planes, widened by what rounding may move a point by.
struct PlaneTree::Query {
  Box box;
  std::array<HalfPlane, 3> sides;
  double slack;
  FunctionRef<bool(std::uint32_t)> accept;

  bool misses(const Box& other) const {
    if (other.u0 > box.u1 || other.u1 < box.u0 || other.v0 > box.v1 || other.v1 < box.v0)
      return true;
    for (const HalfPlane& h : sides)
      if (h.a * (h.a > 0 ? other.u1 : other.u0) + h.b * (h.b > 0 ? other.v1 : other.v0) + h.c <
          -slack)
        return true;
    return false;
  }
};

PlaneTree::PlaneTree(std::vector<PlanePoint> points) : points_(std::move(points)) {
  if (points_.empty()) return;
  std::size_t num_nodes = 1;
  for (std::size_t size = points_.size(); size > kLeaf; size = (size + 1) / 2)
    num_nodes = 2 * num_nodes + 1;
  boxes_.resize(num_nodes);
  build(0, 0, points_.size());
}

void PlaneTree::build(std::size_t node, std::size_t begin, std::size_t end) {
  Box box;
  for (std::size_t i = begin; i < end; ++i) {
    const PlanePoint& p = points_[i];
    box = {std::min(box.u0, p.u), std::min(box.v0, p.v), std::max(box.u1, p.u),
           std::max(box.v1, p.v)};
  }
  boxes_[node] = box;
  if (end - begin <= kLeaf) return;
  const bool splits_u = box.u1 - box.u0 > box.v1 - box.v0;
  const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t middle = (begin + end + 1) / 2;
  std::nth_element(at(begin), at(middle), at(end), [&](const PlanePoint& p, const PlanePoint& q) {
    const double a = splits_u ? p.u : p.v, b = splits_u ? q.u : q.v;
    return a != b ? a < b : p.index < q.index;
  });
  build(2 * node + 1, begin, middle);
  build(2 * node + 2, middle, end);
}

bool PlaneTree::search(const Query& query, std::size_t node, std::size_t begin,
                       std::size_t end) const {
  if (query.misses(boxes_[node])) return false;
  if (end - begin <= kLeaf)
    return std::any_of(points_.begin() + static_cast<std::ptrdiff_t>(begin),
                       points_.begin() + static_cast<std::ptrdiff_t>(end),
                       [&](const PlanePoint& p) { return query.accept(p.index); });
  const std::size_t middle = (begin + end + 1) / 2;
  return search(query, 2 * node + 1, begin, middle) || search(query, 2 * node + 2, middle, end);
}

bool PlaneTree::find_near(const std::array<PlanePoint, 3>& triangle,
                          FunctionRef<bool(std::uint32_t)> accept) const {
  if (points_.empty()) return false;
  const auto [a, b, c] = triangle;
  const Box& all = boxes_[0];
  const double extent = std::max({std::abs(all.u0), std::abs(all.u1), std::abs(all.v0),
                                  std::abs(all.v1), std::abs(a.u), std::abs(a.v)});
  const double slack = 1e-9 * extent;
  const Box box = {std::min({a.u, b.u, c.u}) - slack, std::min({a.v, b.v, c.v}) - slack,
                   std::max({a.u, b.u, c.u}) + slack, std::max({a.v, b.v, c.v}) + slack};
  const Query query = {box, {half_plane(a, b), half_plane(b, c), half_plane(c, a)}, slack, accept};
  return search(query, 0, 0, points_.size());
}

}  // namespace hexwright::io
