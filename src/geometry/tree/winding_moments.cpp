// Moments bottom-up, evaluation top-down.
#include "geometry/tree/winding_moments.h"

#include <numbers>

namespace hexwright {
namespace {

/// Triangles of a subtree occupy consecutive slots: the hierarchy is built by splitting ranges.
struct SlotRange {
  int first = 0, last = 0;
};

Vec3 area_normal(const TriangleData& t) { return cross(t.ab, t.ac) * 0.5; }
Vec3 centroid(const TriangleData& t) { return t.a + (t.ab + t.ac) / 3; }

/// Moments of a subtree about its area-weighted centre (Barill et al. 2018, section 3): the sum of
/// area normals, and the first-order term, the outer products of offsets and normals, of which the
/// symmetric part is all that the expansion uses. Computed from the triangles themselves, not from
/// the children's moments: n log n, and no error adds up.
void set_child(WindingNode::Pair& pair, int k, const std::vector<TriangleData>& slots,
               SlotRange range) {
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
    pair.center[axis][k] = center[axis];
    pair.normal[axis][k] = normal[axis];
  }
  for (int i = 0; i < 6; ++i) pair.moment[i][k] = moment[i];
  pair.radius_sq[k] = radius_sq;
}

/// Gives an unused child the ball of the node's first one.
void copy_ball(WindingNode& node, int k) {
  WindingNode::Pair& pair = node.pair[k / 2];
  for (int axis = 0; axis < 3; ++axis) pair.center[axis][k % 2] = node.pair[0].center[axis][0];
  pair.radius_sq[k % 2] = node.pair[0].radius_sq[0];
}

/// Children first; returns the slots that hang below the node. An unused child gets the ball of
/// child 0, so that the vectorised test of both never meets an undefined number; without moments it
/// adds nothing.
SlotRange fill_node(const TriangleBvh& bvh, const std::vector<TriangleData>& slots, int id,
                    std::vector<WindingNode>& out) {
  const BvhNode& node = bvh.nodes[static_cast<std::size_t>(id)];
  SlotRange all{static_cast<int>(slots.size()), 0};
  for (int k = 0; k < 4; ++k) {
    SlotRange range;
    if (!node.is_leaf(k))
      range = fill_node(bvh, slots, node.child[k], out);
    else
      range = {node.leaf_first(k), node.leaf_first(k) + node.leaf_count(k)};
    WindingNode& winding = out[static_cast<std::size_t>(id)];
    if (range.first == range.last) {
      copy_ball(winding, k);
      continue;
    }
    set_child(winding.pair[k / 2], k % 2, slots, range);
    all = {std::min(all.first, range.first), std::max(all.last, range.last)};
  }
  return all;
}

/// The expansions of two children at offsets d from the query (solid angles).
/// Section 3 of Barill et al.: the dipole, and the first-order term of its Taylor expansion: the
/// Hessian of 1/r against the moments. `d` runs from the query to the centre.
Double2 far_field(const WindingNode::Pair& pair, const Double2 d[3], Double2 distance_sq) {
  const Double2 inverse_sq = splat(1.0) / distance_sq;
  const Double2 inverse = {std::sqrt(inverse_sq[0]), std::sqrt(inverse_sq[1])};
  const auto& n = pair.normal;
  const auto& m = pair.moment;
  const Double2 dipole = n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
  const Double2 trace = m[0] + m[1] + m[2];
  const Double2 quadratic = (m[0] * d[0] + m[3] * d[1]) * d[0] +
                            (m[1] * d[1] + m[4] * d[2]) * d[1] + (m[2] * d[2] + m[5] * d[0]) * d[2];
  return inverse_sq * inverse * (dipole + trace - splat(3.0) * quadratic * inverse_sq);
}

/// Van Oosterom, Strackee, "The solid angle of a plane triangle", IEEE Transactions on Biomedical
/// Engineering 30(2), 1983.
void add_exact(HalfAngleSum& sum, const std::vector<TriangleData>& slots, int first, int count,
               const Vec3& p) {
  for (int i = first; i < first + count; ++i) {
    const TriangleData& t = slots[static_cast<std::size_t>(i)];
    const Vec3 a = t.a - p;
    sum.add(a, a + t.ab, a + t.ac);
  }
}

}  // namespace

std::vector<WindingNode> compute_winding_nodes(const TriangleBvh& bvh,
                                               const std::vector<TriangleData>& slots) {
  std::vector<WindingNode> nodes(bvh.nodes.size(), WindingNode{});
  if (!nodes.empty()) fill_node(bvh, slots, 0, nodes);
  return nodes;
}

/// Near nodes are opened, far ones expanded, two children at a time.
double evaluate_winding(const TriangleBvh& bvh, const std::vector<WindingNode>& nodes,
                        const std::vector<TriangleData>& slots, const Vec3& p, double accuracy) {
  if (nodes.empty()) return 0;
  const Double2 accuracy_sq = splat(accuracy * accuracy);
  HalfAngleSum exact;
  double expanded = 0;
  int stack[3 * kMaxBvhDepth + 4];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const auto id = static_cast<std::size_t>(stack[--top]);
    const BvhNode& node = bvh.nodes[id];
    for (int half = 0; half < 2; ++half) {
      const WindingNode::Pair& pair = nodes[id].pair[half];
      const Double2 d[3] = {pair.center[0] - splat(p.x), pair.center[1] - splat(p.y),
                            pair.center[2] - splat(p.z)};
      const Double2 distance_sq = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
      const auto is_far = distance_sq > accuracy_sq * pair.radius_sq;
      const Double2 far = is_far ? far_field(pair, d, distance_sq) : splat(0.0);
      expanded += far[0] + far[1];
      for (int i = 0; i < 2; ++i) {
        const int k = 2 * half + i;
        if (is_far[i]) continue;
        if (node.is_leaf(k))
          add_exact(exact, slots, node.leaf_first(k), node.leaf_count(k), p);
        else
          stack[top++] = node.child[k];
      }
    }
  }
  return (2 * exact.value() + expanded) / (4 * std::numbers::pi);
}

}  // namespace hexwright
