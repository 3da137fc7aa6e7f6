#include "io/surface/plane_tree.h"

namespace hexwright::io {
namespace {

/// a u + b v + c >= 0 on the inner side of an edge, a and b of unit length.
struct HalfPlane {
  double a = 0, b = 0, c = 0;
};

HalfPlane half_plane(const PlanePoint& p, const PlanePoint& q) {
  const double du = q.u - p.u, dv = q.v - p.v;
  const double length = std::sqrt(du * du + dv * dv);
  if (!(length > 0)) return {};  // keeps everything
  const double a = -dv / length, b = du / length;
  return {a, b, -(a * p.u + b * p.v)};
}

/// A triangle as a box and three half planes, widened by what rounding may move a point by.
struct Query {
  Box3 box;
  std::array<HalfPlane, 3> sides;
  double slack;

  bool meets(const Box3& other) const {
    if (!do_overlap(other, box)) return false;
    for (const HalfPlane& h : sides)
      if (h.a * (h.a > 0 ? other.hi.x : other.lo.x) + h.b * (h.b > 0 ? other.hi.y : other.lo.y) +
              h.c <
          -slack)
        return false;
    return true;
  }
};

Vec3 place(const PlanePoint& p) { return {p.u, p.v, 0}; }

}  // namespace

PlaneTree::PlaneTree(std::vector<PlanePoint> points) : points_(std::move(points)) {
  std::vector<Box3> boxes;
  boxes.reserve(points_.size());
  for (const PlanePoint& p : points_) boxes.push_back({place(p), place(p)});
  tree_ = BoxTree(boxes);
}

bool PlaneTree::find_near(const std::array<PlanePoint, 3>& triangle,
                          FunctionRef<bool(std::uint32_t)> accept) const {
  if (points_.empty()) return false;
  const auto [a, b, c] = triangle;
  const Box3 all = tree_.box();
  const double extent = std::max({std::abs(all.lo.x), std::abs(all.lo.y), std::abs(all.hi.x),
                                  std::abs(all.hi.y), std::abs(a.u), std::abs(a.v)});
  const double slack = 1e-9 * extent;
  Box3 box;
  for (const PlanePoint& p : triangle) box.extend(place(p));
  box = {box.lo - Vec3{slack, slack, 0}, box.hi + Vec3{slack, slack, 0}};
  const Query query = {box, {half_plane(a, b), half_plane(b, c), half_plane(c, a)}, slack};
  return tree_.find([&](const Box3& node) { return query.meets(node); },
                    [&](BoxTree::Item i) { return accept(points_[i].index); });
}

}  // namespace hexwright::io
