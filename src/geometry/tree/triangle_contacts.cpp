#include "geometry/tree/triangle_contacts.h"

#include <algorithm>
#include <cmath>

#include "hexwright/base/parallel.h"

#include "geometry/tree/triangle_bvh.h"
#include "geometry/tree/triangle_math.h"

namespace hexwright {
namespace {

/// Where segment pq passes through the triangle, if both ends are off its plane by more than depth.
std::optional<Vec3> pierce(const Vec3& p, const Vec3& q, const Corners& t, const Vec3& normal,
                           double depth) {
  const double dp = dot(normal, p - t[0]), dq = dot(normal, q - t[0]);
  if (!(dp > depth && dq < -depth) && !(dp < -depth && dq > depth)) return {};
  const Vec3 d = q - p;
  double sign = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double side = det(d, t[k] - p, t[(k + 1) % 3] - p);
    if (side == 0 || side * sign < 0) return {};
    sign = side;
  }
  return p + d * (dp / (dp - dq));
}

Box3 box_of(const Corners& c) {
  Box3 box;
  for (const Vec3& p : c) box.extend(p);
  return box;
}

bool are_apart(const Box3& a, const Box3& b, double gap) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.lo[axis] > b.hi[axis] + gap || b.lo[axis] > a.hi[axis] + gap) return true;
  return false;
}

/// Squared distance of segments p + s u and q + t v with s and t in 0 .. 1: the inner minimum, and
/// the ends against the other segment.
double segment_distance_sq(const Vec3& p, const Vec3& u, const Vec3& q, const Vec3& v) {
  const auto to_segment = [](const Vec3& x, const Vec3& from, const Vec3& along) {
    const double length_sq = norm_sq(along);
    const double s = length_sq > 0 ? std::clamp(dot(x - from, along) / length_sq, 0.0, 1.0) : 0.0;
    return norm_sq(from + along * s - x);
  };
  double least = std::min(
      {to_segment(p, q, v), to_segment(p + u, q, v), to_segment(q, p, u), to_segment(q + v, p, u)});
  const double uu = norm_sq(u), uv = dot(u, v), vv = norm_sq(v);
  const Vec3 w = p - q;
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > 0)) return least;
  const double s = (uv * dot(v, w) - vv * dot(u, w)) / determinant;
  const double t = (uu * dot(v, w) - uv * dot(u, w)) / determinant;
  if (s > 0 && s < 1 && t > 0 && t < 1) least = std::min(least, norm_sq(w + u * s - v * t));
  return least;
}

double vert_distance_sq(const Corners& a, const Corners& b) {
  const TriangleData data = TriangleData::make(b[0], b[1], b[2], {});
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& p : a) {
    const Vec3 ap = p - b[0];
    least = std::min(least, norm_sq(ap - closest_offset(data, ap)));
  }
  return least;
}

std::vector<Box3> boxes_of(const TriMesh& surface) {
  std::vector<Box3> boxes(surface.num_tris());
  for (TriId t : surface.tris.ids()) boxes[t.index()] = box_of(surface.corners(t));
  return boxes;
}

/// Walks the triangles of a hierarchy whose boxes come near another one.
void collect_near(const TriangleBvh& bvh, const std::vector<Box3>& boxes, const Box3& box,
                  double gap, FunctionRef<void(TriId)> visit) {
  // The nodes' boxes are rounded outwards in their frame; the query's is widened by as much.
  constexpr double kRounding = 1e-6;
  float lo[3], hi[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double c = bvh.frame.center[axis], s = bvh.frame.inverse_scale;
    lo[axis] = static_cast<float>((box.lo[axis] - gap - c) * s - kRounding);
    hi[axis] = static_cast<float>((box.hi[axis] + gap - c) * s + kRounding);
  }
  std::vector<std::int32_t> stack{0};
  while (!stack.empty()) {
    const std::int32_t child = stack.back();
    stack.pop_back();
    if (child < 0) {
      const auto leaf = static_cast<std::uint32_t>(~child);
      for (std::uint32_t i = 0; i < (leaf & 7); ++i) {
        const TriId b = bvh.slot_to_tri[leaf / 8 + i];
        if (!are_apart(box, boxes[b.index()], gap)) visit(b);
      }
      continue;
    }
    const BvhNode& node = bvh.nodes[static_cast<std::size_t>(child)];
    for (int k = 0; k < 4; ++k) {
      bool meets = true;
      for (int axis = 0; axis < 3 && meets; ++axis)
        meets = node.lo[axis][k] <= hi[axis] && node.hi[axis][k] >= lo[axis];
      if (meets) stack.push_back(node.child[k]);
    }
  }
}

}  // namespace

std::optional<Vec3> find_crossing(const Corners& a, const Corners& b, double depth) {
  const Vec3 normal_a = unit_normal(a), normal_b = unit_normal(b);
  for (std::size_t k = 0; k < 3; ++k) {
    if (const auto at = pierce(a[k], a[(k + 1) % 3], b, normal_b, depth)) return at;
    if (const auto at = pierce(b[k], b[(k + 1) % 3], a, normal_a, depth)) return at;
  }
  return {};
}

bool are_within(const Corners& a, const Corners& b, double gap) {
  const double limit = gap * gap;
  if (vert_distance_sq(a, b) <= limit || vert_distance_sq(b, a) <= limit) return true;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (segment_distance_sq(a[i], a[(i + 1) % 3] - a[i], b[j], b[(j + 1) % 3] - b[j]) <= limit)
        return true;
  return find_crossing(a, b, 0).has_value();
}

struct NearSurface::Boxes {
  TriangleBvh bvh;
  std::vector<Box3> of_tris;
};

NearSurface::NearSurface(const TriMesh& surface)
    : surface_(surface),
      box_(bounding_box(surface)),
      boxes_(new Boxes{build_triangle_bvh(surface), boxes_of(surface)}) {}

NearSurface::~NearSurface() = default;

bool NearSurface::is_within(const TriMesh& other, double gap) const {
  if (boxes_->bvh.nodes.empty() || are_apart(box_, bounding_box(other), gap)) return false;
  for (TriId t : other.tris.ids()) {
    const Corners corners = other.corners(t);
    const Box3 box = box_of(corners);
    if (are_apart(box_, box, gap)) continue;
    bool is_near = false;
    collect_near(boxes_->bvh, boxes_->of_tris, box, gap, [&](TriId mine) {
      is_near = is_near || are_within(corners, surface_.corners(mine), gap);
    });
    if (is_near) return true;
  }
  return false;
}

std::vector<TriPair> find_near_pairs(const TriMesh& surface, double gap,
                                     FunctionRef<bool(TriId a, TriId b)> accept) {
  const TriangleBvh bvh = build_triangle_bvh(surface);
  if (bvh.nodes.empty()) return {};
  const std::vector<Box3> boxes = boxes_of(surface);
  constexpr std::size_t kGrain = 256;
  return parallel_reduce(
      surface.num_tris(), std::vector<TriPair>{},
      [&](std::size_t begin, std::size_t end) {
        std::vector<TriPair> pairs;
        for (std::size_t i = begin; i < end; ++i) {
          const std::size_t first = pairs.size();
          collect_near(bvh, boxes, boxes[i], gap, [&](TriId b) {
            if (TriId(i) < b && accept(TriId(i), b)) pairs.push_back({TriId(i), b});
          });
          std::sort(pairs.begin() + static_cast<long>(first), pairs.end(),
                    [](const TriPair& p, const TriPair& q) { return p.b < q.b; });
        }
        return pairs;
      },
      [](std::vector<TriPair> all, const std::vector<TriPair>& more) {
        all.insert(all.end(), more.begin(), more.end());
        return all;
      },
      kGrain);
}

}  // namespace hexwright
