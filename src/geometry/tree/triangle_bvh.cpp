// Top-down build: binned surface area heuristic into a binary tree, then collapsed to width four.
#include "geometry/tree/triangle_bvh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/box_tree.h"

namespace hexwright {
namespace {

constexpr int kLeafSize = 4;
constexpr int kNumBins = 16;
/// Below this depth splits are medians, which bounds the depth by 24 + log2(number of triangles).
constexpr int kHeuristicDepth = 24;

double half_area(const Box3& box) {
  const Vec3 e = box.extent();
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

/// A triangle while the tree is built: boxes in the frame, where all sizes are near 1.
struct Item {
  Box3 box;  // in the frame
  Vec3 center;
  TriId tri;
};

struct BinaryNode {
  Box3 box;
  int left = -1, right = -1;  // children, or
  int first = 0, count = 0;   // the triangles of a leaf
};

/// Triangles whose centre falls into one of the slices of a range.
struct Bin {
  Box3 box;
  int count = 0;
};

class Builder {
 public:
  Builder(const TriMesh& surface, const BvhFrame& frame) {
    items_.reserve(surface.num_tris());
    for (TriId t : surface.tris.ids()) {
      Item item;
      for (const Vec3& p : surface.corners(t))
        item.box.extend((p - frame.center) * frame.inverse_scale);
      item.center = item.box.center();
      item.tri = t;
      items_.push_back(item);
    }
  }

  /// Builds the binary tree over a range of items and returns its root. The order of the items
  /// becomes the order of the leaves, so every subtree owns a range of consecutive slots
  /// (winding_moments relies on it).
  int build(int first, int count, int depth) {
    const int id = static_cast<int>(binary_.size());
    binary_.emplace_back();
    Box3 box, centers;
    for (int i = first; i < first + count; ++i) {
      box.extend(item(i).box);
      centers.extend(item(i).center);
    }
    node(id).box = box;
    if (count <= kLeafSize) {
      node(id).first = first;
      node(id).count = count;
      return id;
    }
    const int middle = split(first, count, centers, depth);
    const int left = build(first, middle - first, depth + 1);
    const int right = build(middle, first + count - middle, depth + 1);
    node(id).left = left;
    node(id).right = right;
    return id;
  }

  /// Appends the wide node of a binary one and of all below it; returns its number.
  int emit(TriangleBvh& bvh, int binary, int depth) {
    const int id = static_cast<int>(bvh.nodes.size());
    bvh.nodes.emplace_back();
    bvh.depth = std::max(bvh.depth, depth);
    const auto [children, num_children] = open(binary);
    BvhNode wide = empty_node();
    for (int k = 0; k < num_children; ++k) {
      const BinaryNode& child = node(children[static_cast<std::size_t>(k)]);
      set_box(wide, k, child.box);
      wide.child[k] = child.left < 0 ? ~(child.first * 8 + child.count)
                                     : emit(bvh, children[static_cast<std::size_t>(k)], depth + 1);
    }
    bvh.nodes[static_cast<std::size_t>(id)] = wide;
    return id;
  }

  std::vector<TriId> order() const {
    std::vector<TriId> tris;
    tris.reserve(items_.size());
    for (const Item& i : items_) tris.push_back(i.tri);
    return tris;
  }

 private:
  Item& item(int i) { return items_[static_cast<std::size_t>(i)]; }
  BinaryNode& node(int i) { return binary_[static_cast<std::size_t>(i)]; }

  /// The heuristic can peel off one triangle at a time; medians below a fixed depth bound the
  /// depth, and with it the stacks of the queries.
  int split(int first, int count, const Box3& centers, int depth) {
    if (depth < kHeuristicDepth) {
      const int middle = split_by_area(first, count, centers);
      if (middle > first && middle < first + count) return middle;
    }
    return split_at_median(first, count, centers);
  }

  int split_at_median(int first, int count, const Box3& centers) {
    const auto begin = items_.begin() + first;
    hexwright::split_at_median(begin, begin + count / 2, begin + count,
                               longest_axis(centers.extent()),
                               [](const Item& item) { return std::pair(item.center, item.tri); });
    return first + count / 2;
  }

  static int bin_of(const Item& item, int axis, double lo, double inverse) {
    return std::clamp(static_cast<int>((item.center[axis] - lo) * inverse), 0, kNumBins - 1);
  }

  /// The cheapest of all borders between bins on the three axes; `first` when there is none.
  int split_by_area(int first, int count, const Box3& centers) {
    double best_cost = std::numeric_limits<double>::infinity();
    int best_axis = -1, best_border = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double extent = centers.extent()[axis];
      if (!(extent > 0)) continue;
      std::array<Bin, kNumBins> bins;
      for (int i = first; i < first + count; ++i) {
        const int b = bin_of(item(i), axis, centers.lo[axis], kNumBins / extent);
        Bin& bin = bins[static_cast<std::size_t>(b)];
        bin.box.extend(item(i).box);
        ++bin.count;
      }
      const auto [cost, border] = cheapest_border(bins);
      if (cost >= best_cost) continue;
      best_cost = cost;
      best_axis = axis;
      best_border = border;
    }
    if (best_axis < 0) return first;
    const double inverse = kNumBins / centers.extent()[best_axis];
    const auto middle = std::stable_partition(
        items_.begin() + first, items_.begin() + first + count, [&](const Item& i) {
          return bin_of(i, best_axis, centers.lo[best_axis], inverse) < best_border;
        });
    return static_cast<int>(middle - items_.begin());
  }

  /// Costs of all borders in two sweeps: areas times counts from the right, then from the left.
  /// MacDonald, Booth, "Heuristics for ray tracing using space subdivision", The Visual Computer 6,
  /// 1990.
  static std::pair<double, int> cheapest_border(const std::array<Bin, kNumBins>& bins) {
    std::array<double, kNumBins> right_cost{};
    Bin sum;
    for (std::size_t b = kNumBins - 1; b > 0; --b) {
      sum.box.extend(bins[b].box);
      sum.count += bins[b].count;
      right_cost[b] = sum.count ? half_area(sum.box) * sum.count : 0;
    }
    sum = {};
    std::pair<double, int> best{std::numeric_limits<double>::infinity(), 0};
    for (std::size_t b = 1; b < kNumBins; ++b) {
      sum.box.extend(bins[b - 1].box);
      sum.count += bins[b - 1].count;
      const double cost = (sum.count ? half_area(sum.box) * sum.count : 0) + right_cost[b];
      if (cost < best.first) best = {cost, static_cast<int>(b)};
    }
    return best;
  }

  /// Replaces the largest inner child by its two children while fewer than four.
  std::pair<std::array<int, 4>, int> open(int binary) {
    std::array<int, 4> children{binary, -1, -1, -1};
    int count = 1;
    while (count < 4) {
      int widest = -1;
      double area = -1;
      for (int k = 0; k < count; ++k) {
        const BinaryNode& child = node(children[static_cast<std::size_t>(k)]);
        if (child.left < 0 || half_area(child.box) <= area) continue;
        area = half_area(child.box);
        widest = k;
      }
      if (widest < 0) break;
      const BinaryNode& opened = node(children[static_cast<std::size_t>(widest)]);
      children[static_cast<std::size_t>(widest)] = opened.left;
      children[static_cast<std::size_t>(count++)] = opened.right;
    }
    return {children, count};
  }

  /// Unused children have boxes that nothing is near to, and leaves without triangles.
  static BvhNode empty_node() {
    BvhNode wide;
    for (int k = 0; k < 4; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        wide.lo[axis][k] = std::numeric_limits<float>::infinity();
        wide.hi[axis][k] = -std::numeric_limits<float>::infinity();
      }
      wide.child[k] = ~0;
    }
    return wide;
  }

  /// Rounded outwards, so that a float box always holds its triangles.
  static void set_box(BvhNode& wide, int k, const Box3& box) {
    constexpr float kBig = 4;  // beyond every coordinate of the frame
    for (int axis = 0; axis < 3; ++axis) {
      wide.lo[axis][k] = std::nextafterf(static_cast<float>(box.lo[axis]), -kBig);
      wide.hi[axis][k] = std::nextafterf(static_cast<float>(box.hi[axis]), kBig);
    }
  }

  std::vector<Item> items_;
  std::vector<BinaryNode> binary_;
};

/// A surface that is a point, or too small for its inverse, keeps scale 1.
BvhFrame frame_of(const Box3& box) {
  BvhFrame frame;
  if (box.is_empty()) return frame;
  // Halves first: the sum of two huge coordinates could overflow.
  const Vec3 half = box.hi * 0.5 - box.lo * 0.5;
  frame.center = box.lo * 0.5 + box.hi * 0.5;
  const double radius = std::max({half.x, half.y, half.z});
  frame.inverse_scale = radius > 0 && std::isfinite(1 / radius) ? 1 / radius : 1;
  return frame;
}

}  // namespace

TriangleBvh build_triangle_bvh(const TriMesh& surface) {
  TriangleBvh bvh;
  bvh.frame = frame_of(bounding_box(surface));
  if (surface.num_tris() == 0) return bvh;
  Builder builder(surface, bvh.frame);
  const int root = builder.build(0, static_cast<int>(surface.num_tris()), 0);
  builder.emit(bvh, root, 1);
  bvh.slot_to_tri = builder.order();
  return bvh;
}

}  // namespace hexwright
