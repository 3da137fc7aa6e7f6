// Closest-point queries by ordered descent; winding numbers by far-field expansion.
//
// Invariants: box distances are lower bounds of true ones (floats rounded outwards, queries with a
// slack), so pruning never loses the nearest triangle; ties go to the lowest triangle id, so
// results depend neither on the tree's shape nor on hints.
#include "hexwright/geometry/surface_tree.h"

#include <algorithm>
#include <utility>

#include "hexwright/base/assert.h"
#include "hexwright/base/parallel.h"
#include "hexwright/geometry/patch_index.h"

#include "geometry/tree/triangle_bvh.h"
#include "geometry/tree/triangle_math.h"
#include "geometry/tree/winding_moments.h"

namespace hexwright {
namespace {

/// The query point in the frame of the boxes, with the slack that makes every box distance a lower
/// bound of the true one.
struct BoxQuery {
  float p[3];
  float slack;

  BoxQuery(const BvhFrame& frame, const Vec3& world) {
    // Far points are moved to a far box, which only lowers distances to what is inside it.
    constexpr double kFar = 1e15;
    double largest = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double x =
          std::clamp((world[axis] - frame.center[axis]) * frame.inverse_scale, -kFar, kFar);
      p[axis] = static_cast<float>(x);
      largest = std::max(largest, std::abs(x));
    }
    slack = static_cast<float>(4e-7 * largest);
  }
};

/// Lower bounds of the squared distances to the four children.
Float4 box_distances(const BvhNode& node, const BoxQuery& q) {
  Float4 sum = splat(0.0f);
  for (int axis = 0; axis < 3; ++axis) {
    const Float4 p = splat(q.p[axis]);
    const Float4 outside = max(node.lo[axis] - p, p - node.hi[axis]) - splat(q.slack);
    const Float4 d = max(outside, splat(0.0f));
    sum += d * d;
  }
  return sum;
}

/// A ray in the frame of the boxes, in floats, with the slack that makes every box that it enters
/// one that it is found to enter, and not later than it does.
struct BoxRay {
  float p[3], inverse[3];
  float slack;

  BoxRay(const BvhFrame& frame, const Vec3& from, const Vec3& d) {
    constexpr double kFar = 1e15;
    constexpr double kLeast = 1e-12;  // of a component of the direction: less leads nowhere
    double largest = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double x =
          std::clamp((from[axis] - frame.center[axis]) * frame.inverse_scale, -kFar, kFar);
      p[axis] = static_cast<float>(x);
      inverse[axis] = static_cast<float>(
          1 / (std::abs(d[axis]) > kLeast ? d[axis] : std::copysign(kLeast, d[axis])));
      largest = std::max(largest, std::abs(x));
    }
    slack = static_cast<float>(1e-6 * largest);
  }
};

/// Where the ray enters the four children, at the earliest; beyond `limit` where it does not.
Float4 box_entries(const BvhNode& node, const BoxRay& ray, float limit) {
  Float4 enter = splat(0.0f), leave = splat(limit);
  for (int axis = 0; axis < 3; ++axis) {
    const Float4 p = splat(ray.p[axis]), inverse = splat(ray.inverse[axis]);
    const Float4 a = (node.lo[axis] - splat(ray.slack) - p) * inverse;
    const Float4 b = (node.hi[axis] + splat(ray.slack) - p) * inverse;
    enter = max(enter, min(a, b));
    leave = min(leave, max(a, b));
  }
  return enter <= leave ? enter : splat(std::numeric_limits<float>::infinity());
}

/// Nodes still to visit, nearest last.
class VisitStack {
 public:
  struct Entry {
    float distance_sq;  // of rays: where the box is entered
    std::int32_t child;
  };
  bool empty() const { return top_ == 0; }
  Entry pop() { return entries_[--top_]; }
  /// Inserts below the top so that the entries from `from` on stay sorted, nearest last.
  void push_sorted(Entry e, int from) {
    int i = top_++;
    for (; i > from && entries_[i - 1].distance_sq < e.distance_sq; --i)
      entries_[i] = entries_[i - 1];
    entries_[i] = e;
  }
  int size() const { return top_; }

 private:
  Entry entries_[3 * kMaxBvhDepth + 4];
  int top_ = 0;
};

}  // namespace

struct SurfaceTree::Impl {
  TriMesh surface;
  Box3 box;
  double diagonal = 0;
  TriangleBvh bvh;
  IdVector<TriId, Vec3> normals;
  std::vector<TriangleData> slots;  // triangles in leaf order
  IdVector<TriId, int> tri_to_slot;
  std::vector<WindingNode> winding;

  /// The best so far of one query.
  struct Best {
    double distance_sq = std::numeric_limits<double>::infinity();
    std::int32_t tri = std::numeric_limits<std::int32_t>::max();
    int slot = -1;
    Vec3 offset;  // from the triangle's first corner
    bool is_found() const { return slot >= 0; }
  };

  explicit Impl(TriMesh mesh);
  template <bool kByNormal, bool kByPatch>
  void test_slot(int slot, const Vec3& p, const ClosestFilter& filter, Best& best) const;
  /// Filters are template parameters: plain queries are by far the most, and pay for none.
  template <bool kByNormal, bool kByPatch>
  void search(const Vec3& p, const ClosestFilter& filter, Best& best) const;
  /// Squared distance of the best in the frame of the boxes, rounded up.
  float bound(const Best& best) const {
    const double d = best.distance_sq * bvh.frame.inverse_scale * bvh.frame.inverse_scale;
    return static_cast<float>(std::min(d * 1.000001 + 1e-37, 1e38));
  }
};

SurfaceTree::Impl::Impl(TriMesh mesh)
    : surface(std::move(mesh)),
      box(bounding_box(surface)),
      bvh(build_triangle_bvh(surface)),
      normals(surface.num_tris()),
      slots(surface.num_tris()),
      tri_to_slot(surface.num_tris()) {
  parallel_for(slots.size(), [&](std::size_t s) {
    const TriId t = bvh.slot_to_tri[s];
    const auto corners = surface.corners(t);
    normals[t] = unit_normal(corners);
    slots[s] = TriangleData::make(corners[0], corners[1], corners[2], normals[t]);
    tri_to_slot[t] = static_cast<int>(s);
  });
  winding = compute_winding_nodes(bvh, slots);
}

template <bool kByNormal, bool kByPatch>
void SurfaceTree::Impl::test_slot(int slot, const Vec3& p, const ClosestFilter& filter,
                                  Best& best) const {
  const auto s = static_cast<std::size_t>(slot);
  const TriangleData& t = slots[s];
  if constexpr (kByPatch)
    if (filter.patches->slot_to_patch_[s] != filter.patch.value()) return;
  if constexpr (kByNormal)
    if (!(dot(filter.normal, t.normal) >= filter.min_cosine)) return;
  const Vec3 ap = p - t.a;
  const Vec3 offset = closest_offset(t, ap);
  const double d = norm_sq(ap - offset);
  if (d > best.distance_sq || !(d <= best.distance_sq)) return;
  const std::int32_t tri = bvh.slot_to_tri[s].value();
  if (d == best.distance_sq && tri >= best.tri) return;
  best = {d, tri, slot, offset};
}

/// Best first among siblings, depth first among levels: children are pushed farthest first, and
/// entries that a better find has overtaken are dropped when they are popped.
template <bool kByNormal, bool kByPatch>
void SurfaceTree::Impl::search(const Vec3& p, const ClosestFilter& filter, Best& best) const {
  const BoxQuery query(bvh.frame, p);
  VisitStack stack;
  stack.push_sorted({0, 0}, 0);
  float limit = bound(best);
  while (!stack.empty()) {
    const auto entry = stack.pop();
    if (entry.distance_sq > limit) continue;
    if (entry.child < 0) {
      const auto leaf = static_cast<std::uint32_t>(~entry.child);
      for (std::uint32_t i = 0; i < (leaf & 7); ++i)
        test_slot<kByNormal, kByPatch>(static_cast<int>(leaf / 8 + i), p, filter, best);
      limit = bound(best);
      continue;
    }
    const BvhNode& node = bvh.nodes[static_cast<std::size_t>(entry.child)];
    const Float4 distance_sq = box_distances(node, query);
    const int from = stack.size();
    for (int k = 0; k < 4; ++k) {
      if (!(distance_sq[k] <= limit)) continue;
      if constexpr (kByPatch) {
        const auto& of_node = filter.patches->nodes_[static_cast<std::size_t>(entry.child)];
        if (of_node.patch[k] != filter.patch.value() && of_node.patch[k] != PatchIndex::kMixed)
          continue;
      }
      stack.push_sorted({distance_sq[k], node.child[k]}, from);
    }
  }
}

SurfaceTree::SurfaceTree(TriMesh surface, double diagonal)
    : impl_(std::make_unique<Impl>(std::move(surface))) {
  impl_->diagonal = diagonal > 0 ? diagonal : impl_->box.diagonal();
}
SurfaceTree::~SurfaceTree() = default;
SurfaceTree::SurfaceTree(SurfaceTree&&) noexcept = default;
SurfaceTree& SurfaceTree::operator=(SurfaceTree&&) noexcept = default;

const TriMesh& SurfaceTree::surface() const { return impl_->surface; }
const Box3& SurfaceTree::box() const { return impl_->box; }
double SurfaceTree::diagonal() const { return impl_->diagonal; }
const Vec3& SurfaceTree::normal(TriId t) const { return impl_->normals[t]; }

const TriangleBvh& SurfaceTree::bvh() const { return impl_->bvh; }

std::optional<ClosestPoint> SurfaceTree::closest(const Vec3& p, const ClosestFilter& filter) const {
  const Impl& tree = *impl_;
  const bool by_normal = filter.min_cosine >= -1;
  const bool by_patch = filter.patch.is_valid();
  if (tree.bvh.nodes.empty()) return std::nullopt;
  if (by_patch && (!filter.patches || filter.patches->empty())) return std::nullopt;
  HEXWRIGHT_ASSERT(!by_patch || filter.patches->slot_to_patch_.size() == tree.slots.size());
  if (!(filter.max_distance >= 0)) return std::nullopt;
  Impl::Best best;
  best.distance_sq = filter.max_distance * filter.max_distance;
  const auto run = [&]<bool kByNormal, bool kByPatch>() {
    if (filter.hint.is_valid())
      tree.test_slot<kByNormal, kByPatch>(tree.tri_to_slot[filter.hint], p, filter, best);
    tree.search<kByNormal, kByPatch>(p, filter, best);
  };
  if (by_normal)
    by_patch ? run.operator()<true, true>() : run.operator()<true, false>();
  else
    by_patch ? run.operator()<false, true>() : run.operator()<false, false>();
  if (!best.is_found()) return std::nullopt;
  const Vec3 point = tree.slots[static_cast<std::size_t>(best.slot)].a + best.offset;
  return ClosestPoint{TriId(best.tri), point, best.distance_sq};
}

/// As the search for the closest point: nearest boxes first, those beyond the best hit left out.
std::optional<RayHit> SurfaceTree::first_hit(const Vec3& p, const Vec3& d,
                                             FunctionRef<bool(const RayHit&)> counts) const {
  const Impl& tree = *impl_;
  if (tree.bvh.nodes.empty()) return std::nullopt;
  const BoxRay ray(tree.bvh.frame, p, d);
  RayHit best{TriId(), std::numeric_limits<double>::infinity()};
  const auto test_slot = [&](std::size_t slot) {
    const RayHit hit{tree.bvh.slot_to_tri[slot], ray_length(tree.slots[slot], p, d)};
    if (!(hit.length >= 0) || hit.length > best.length) return;
    if (hit.length == best.length && best.tri.is_valid() && !(hit.tri < best.tri)) return;
    if (counts(hit)) best = hit;
  };
  VisitStack stack;
  stack.push_sorted({0, 0}, 0);
  constexpr float kNowhere = 1e30f;
  float limit = kNowhere;
  while (!stack.empty()) {
    const auto entry = stack.pop();
    if (entry.distance_sq > limit) continue;
    if (entry.child < 0) {
      const auto leaf = static_cast<std::uint32_t>(~entry.child);
      for (std::uint32_t i = 0; i < (leaf & 7); ++i) test_slot(leaf / 8 + i);
      const double reached = best.length * tree.bvh.frame.inverse_scale;
      limit = static_cast<float>(std::min(reached * 1.00001, static_cast<double>(kNowhere)));
      continue;
    }
    const BvhNode& node = tree.bvh.nodes[static_cast<std::size_t>(entry.child)];
    const Float4 enter = box_entries(node, ray, limit);
    const int from = stack.size();
    for (int k = 0; k < 4; ++k)
      if (enter[k] <= limit && node.child[k] != ~0)
        stack.push_sorted({enter[k], node.child[k]}, from);
  }
  if (!best.tri.is_valid()) return std::nullopt;
  return best;
}

double SurfaceTree::distance(const Vec3& p) const {
  const auto found = closest(p);
  return found ? std::sqrt(found->distance_sq) : std::numeric_limits<double>::infinity();
}

double SurfaceTree::winding_number(const Vec3& p, double accuracy) const {
  return evaluate_winding(impl_->bvh, impl_->winding, impl_->slots, p, accuracy);
}

}  // namespace hexwright
