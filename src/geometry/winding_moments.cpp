// Moments bottom-up, evaluation top-down.
#include "geometry/winding_moments.h"

#include <numbers>

namespace hexwright {
namespace {

/// Triangles of a subtree occupy consecutive slots: the hierarchy is built by splitting ranges.
struct SlotRange {
  int first = 0, last = 0;
};

Vec3 area_normal(const TriangleData& t) { return cross(t.ab, t.ac) * 0.5; }
Vec3 centroid(const TriangleData& t) { return t.a + (t.ab + t.ac) / 3; }

void set_child(WindingNode& node, int k, const std::vector<TriangleData>& slots, SlotRange range) {
  double area = 0;
  Vec3 normal, weighted;
  const Vec3 origin = slots[static_cast<std::size_t>(range.first)].a;
  for (int s = range.first; s < range.last; ++s) {
    const TriangleData& t = slots[static_cast<std::size_t>(s)];
    const Vec3 n = area_normal(t);
    normal += n;
    area += norm(n);
    weighted += (centroid(t) - origin) * norm(n);
  }
  const Vec3 center = area > 0 ? origin + weighted / area : origin;
  double moment[6] = {}, radius_sq = 0;
  for (int s = range.first; s < range.last; ++s) {
    const TriangleData& t = slots[static_cast<std::size_t>(s)];
    const Vec3 n = area_normal(t), e = centroid(t) - center;
    moment[0] += n.x * e.x;
    moment[1] += n.y * e.y;
    moment[2] += n.z * e.z;
    moment[3] += n.x * e.y + n.y * e.x;
    moment[4] += n.y * e.z + n.z * e.y;
    moment[5] += n.z * e.x + n.x * e.z;
    for (const Vec3& q : {t.a, t.a + t.ab, t.a + t.ac})
      radius_sq = std::max(radius_sq, norm_sq(q - center));
  }
  for (int axis = 0; axis < 3; ++axis) {
    node.center[axis][k] = center[axis];
    node.normal[axis][k] = normal[axis];
  }
  for (int i = 0; i < 6; ++i) node.moment[i][k] = moment[i];
  node.radius_sq[k] = radius_sq;
}

SlotRange fill_node(const TriangleBvh& bvh, const std::vector<TriangleData>& slots, int id,
                    std::vector<WindingNode>& out) {
  const BvhNode& node = bvh.nodes[static_cast<std::size_t>(id)];
  SlotRange all{static_cast<int>(slots.size()), 0};
  for (int k = 0; k < 4; ++k) {
    SlotRange range;
    if (!node.is_leaf(k)) {
      range = fill_node(bvh, slots, node.child[k], out);
    } else {
      range = {node.leaf_first(k), node.leaf_first(k) + node.leaf_count(k)};
      if (node.leaf_count(k) == 0) continue;
    }
    set_child(out[static_cast<std::size_t>(id)], k, slots, range);
    all = {std::min(all.first, range.first), std::max(all.last, range.last)};
  }
  return all;
}

/// The expansion of child k at offset d from the query (solid angle, not divided by 4 pi).
double far_field(const WindingNode& node, int k, const Vec3& d, double distance_sq) {
  const double inverse_sq = 1 / distance_sq;
  const double inverse_cubed = inverse_sq * std::sqrt(inverse_sq);
  const double dipole = node.normal[0][k] * d.x + node.normal[1][k] * d.y + node.normal[2][k] * d.z;
  const auto& m = node.moment;
  const double trace = m[0][k] + m[1][k] + m[2][k];
  const double quadratic = m[0][k] * d.x * d.x + m[1][k] * d.y * d.y + m[2][k] * d.z * d.z +
                           m[3][k] * d.x * d.y + m[4][k] * d.y * d.z + m[5][k] * d.z * d.x;
  return inverse_cubed * (dipole + trace - 3 * quadratic * inverse_sq);
}

}  // namespace

std::vector<WindingNode> compute_winding_nodes(const TriangleBvh& bvh,
                                               const std::vector<TriangleData>& slots) {
  std::vector<WindingNode> nodes(bvh.nodes.size(), WindingNode{});
  if (!nodes.empty()) fill_node(bvh, slots, 0, nodes);
  return nodes;
}

double evaluate_winding(const TriangleBvh& bvh, const std::vector<WindingNode>& nodes,
                        const std::vector<TriangleData>& slots, const Vec3& p, double accuracy) {
  if (nodes.empty()) return 0;
  const double accuracy_sq = accuracy * accuracy;
  double half_angle = 0, angle = 0;  // exact and expanded parts
  int stack[3 * kMaxBvhDepth + 4];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const auto id = static_cast<std::size_t>(stack[--top]);
    const BvhNode& node = bvh.nodes[id];
    const WindingNode& far = nodes[id];
    for (int k = 0; k < 4; ++k) {
      const int count = node.is_leaf(k) ? node.leaf_count(k) : -1;
      if (count == 0) continue;
      const Vec3 d{far.center[0][k] - p.x, far.center[1][k] - p.y, far.center[2][k] - p.z};
      const double distance_sq = norm_sq(d);
      if (distance_sq > accuracy_sq * far.radius_sq[k]) {
        angle += far_field(far, k, d, distance_sq);
      } else if (count < 0) {
        stack[top++] = node.child[k];
      } else {
        for (int i = 0; i < count; ++i) {
          const TriangleData& t = slots[static_cast<std::size_t>(node.leaf_first(k) + i)];
          const Vec3 a = t.a - p;
          half_angle += half_solid_angle(a, a + t.ab, a + t.ac);
        }
      }
    }
  }
  return (2 * half_angle + angle) / (4 * std::numbers::pi);
}

}  // namespace hexwright
