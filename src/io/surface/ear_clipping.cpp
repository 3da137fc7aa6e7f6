// Cuts ears off a polygon until a triangle is left.
//
// Based on: Meisters, "Polygons have ears", American Mathematical Monthly 82(6), 1975; Held, "FIST:
// fast industrial-strength triangulation of polygons", Algorithmica 30(4), 2001 (only reflex
// vertices can lie in an ear, and they are found in an index of their places).
// Differs: the index is a tree of boxes. A vertex that was cut off lies outside what remains, so
// that the reflex vertices of the whole polygon serve to the end: whether a corner is an ear
// depends on its own triangle alone. A cut therefore changes two corners, and the ears are kept in
// a set: 3n tests in all, each of logarithmic time but for long triangles among many vertices.
#include "io/surface/ear_clipping.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>

#include "hexwright/base/cancel.h"

#include "io/surface/plane_tree.h"

namespace hexwright::io {
namespace {

using Tri = std::array<VertId, 3>;

class EarClipper {
 public:
  EarClipper(const IdVector<VertId, Vec3>& positions, std::span<const VertId> polygon)
      : positions_(positions),
        polygon_(polygon),
        plane_(positions[polygon[0]], newell_normal(positions, polygon)),
        previous_(polygon.size()),
        next_(polygon.size()) {
    const auto n = static_cast<std::uint32_t>(polygon.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      previous_[i] = (i + n - 1) % n;
      next_[i] = (i + 1) % n;
    }
    if (!plane_.is_proper()) return;  // all on a line, or beyond the range of numbers: no ears
    reflex_ = PlaneTree(project_reflex());
    CancelCheck check_cancelled;
    for (std::uint32_t i = 0; i < n; ++i) {
      check_cancelled();
      update(i);
    }
  }

  void run(std::vector<Tri>& out) {
    std::uint32_t start = 0;
    CancelCheck check_cancelled;
    for (std::size_t left = polygon_.size(); left > 3 && !ears_.empty(); --left) {
      check_cancelled();
      const std::uint32_t ear = first_ear(start);
      out.push_back(corner(ear));
      // Not the neighbour: a convex polygon is cut evenly, not into a fan.
      start = next_[next_[ear]];
      cut(ear);
    }
    const std::uint32_t first = first_left_;
    for (std::uint32_t i = next_[first]; next_[i] != first; i = next_[i])
      out.push_back({polygon_[first], polygon_[i], polygon_[next_[i]]});
  }

 private:
  /// The reflex vertices, one for each place: what lies in an ear is a matter of places.
  std::vector<PlanePoint> project_reflex() const {
    std::vector<std::uint32_t> reflex;
    for (std::uint32_t i = 0; i < polygon_.size(); ++i)
      if (!is_convex(corner(i))) reflex.push_back(i);
    const auto place = [&](std::uint32_t i) -> const Vec3& { return positions_[polygon_[i]]; };
    std::sort(reflex.begin(), reflex.end(), [&](std::uint32_t i, std::uint32_t k) {
      const Vec3 &p = place(i), &q = place(k);
      return std::tie(p.x, p.y, p.z, i) < std::tie(q.x, q.y, q.z, k);
    });
    const auto last =
        std::unique(reflex.begin(), reflex.end(),
                    [&](std::uint32_t i, std::uint32_t k) { return place(i) == place(k); });
    std::vector<PlanePoint> points;
    for (auto i = reflex.begin(); i != last; ++i) points.push_back(plane_.project(place(*i), *i));
    return points;
  }

  Tri corner(std::uint32_t i) const {
    return {polygon_[previous_[i]], polygon_[i], polygon_[next_[i]]};
  }

  /// The first ear in the polygon's order from `start` on, or around its end.
  std::uint32_t first_ear(std::uint32_t start) const {
    const auto found = ears_.lower_bound(start);
    return found == ears_.end() ? *ears_.begin() : *found;
  }

  void cut(std::uint32_t i) {
    const std::uint32_t before = previous_[i], after = next_[i];
    next_[before] = after;
    previous_[after] = before;
    if (i == first_left_) first_left_ = after;
    ears_.erase(i);
    update(before);
    update(after);
  }

  void update(std::uint32_t i) {
    if (is_ear(corner(i)))
      ears_.insert(i);
    else
      ears_.erase(i);
  }

  double side(VertId a, VertId b, VertId p) const {
    return dot(plane_.normal, cross(positions_[b] - positions_[a], positions_[p] - positions_[a]));
  }
  bool is_convex(const Tri& t) const { return side(t[0], t[1], t[2]) > 0; }

  bool is_ear(const Tri& t) const {
    if (!is_convex(t)) return false;
    const std::array<PlanePoint, 3> triangle = {plane_.project(positions_[t[0]], 0),
                                                plane_.project(positions_[t[1]], 0),
                                                plane_.project(positions_[t[2]], 0)};
    return !reflex_.find_near(triangle, [&](std::uint32_t i) { return blocks(t, polygon_[i]); });
  }

  bool blocks(const Tri& t, VertId v) const {
    // Bridges to holes visit a place twice, under one id or two.
    const Vec3& p = positions_[v];
    if (p == positions_[t[0]] || p == positions_[t[1]] || p == positions_[t[2]]) return false;
    return side(t[0], t[1], v) >= 0 && side(t[1], t[2], v) >= 0 && side(t[2], t[0], v) >= 0;
  }

  const IdVector<VertId, Vec3>& positions_;
  std::span<const VertId> polygon_;
  Plane plane_;
  std::vector<std::uint32_t> previous_, next_;  // of the corners that are left
  std::uint32_t first_left_ = 0;                // the least of them
  std::set<std::uint32_t> ears_;
  PlaneTree reflex_;
};

}  // namespace

/// Points relative to the first one, so that a polygon far from the origin keeps its digits.
Vec3 newell_normal(const IdVector<VertId, Vec3>& positions, std::span<const VertId> polygon) {
  Vec3 normal;
  const Vec3 origin = positions[polygon[0]];
  for (std::size_t i = 0; i < polygon.size(); ++i)
    normal += cross(positions[polygon[i]] - origin,
                    positions[polygon[(i + 1) % polygon.size()]] - origin);
  return normal;
}

void clip_ears(const IdVector<VertId, Vec3>& positions, std::span<const VertId> polygon,
               std::vector<Tri>& out) {
  EarClipper(positions, polygon).run(out);
}

}  // namespace hexwright::io
