#include "relax/kernel/fixed_bound.h"

#include <algorithm>

#include "hexwright/base/parallel.h"
#include "hexwright/quality/hex_quality.h"

namespace hexwright::relax {
namespace {

// A corner at a held vertex with one free neighbour: the cross product of its two held unit edges,
// towards the free one.
struct HeldCorner {
  VertId free;
  Vec3 normal;
  HexId hex;
};

// The norm of a point of the convex hull close to the origin (Gilbert's iteration): an upper bound
// of the least n . d over unit d, and nearly the best one.
double hull_distance(const std::vector<HeldCorner>& corners, std::size_t begin, std::size_t end) {
  Vec3 z;
  for (std::size_t i = begin; i < end; ++i) z += corners[i].normal;
  z = z / static_cast<double>(end - begin);
  for (int step = 0; step < 60; ++step) {
    std::size_t worst = begin;
    for (std::size_t i = begin; i < end; ++i)
      if (dot(corners[i].normal, z) < dot(corners[worst].normal, z)) worst = i;
    const Vec3 e = corners[worst].normal - z;
    const double t = norm_sq(e) > 0 ? std::clamp(-dot(z, e) / norm_sq(e), 0.0, 1.0) : 0.0;
    if (t < 1e-9) break;
    z += t * e;
  }
  return norm(z);
}

struct VertexBound {
  const HexMesh& mesh;
  const VertToHex& vert_to_hex;
  const IdVector<VertId, char>& is_held;

  void lower(QualityBound& bound, double value, HexId h) const {
    if (value < bound.value) bound = {value, h};
  }

  // Corners with one free neighbour are collected, those held entirely bound at once.
  void add_corner(const HexCorner& corner, std::vector<HeldCorner>& held,
                  QualityBound& bound) const {
    const auto& hex = mesh.hexes[corner.hex];
    const auto& neighbors = kHexCornerNeighbors[static_cast<std::size_t>(corner.lv)];
    int num_free = 0;
    std::size_t free = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (is_held[hex[static_cast<std::size_t>(neighbors[k])]]) continue;
      ++num_free;
      free = k;
    }
    if (num_free == 0) {
      lower(bound, corner_scaled_jacobian(mesh.corners(corner.hex), corner.lv), corner.hex);
    } else if (num_free == 1) {
      const Vec3& origin = mesh.positions[hex[static_cast<std::size_t>(corner.lv)]];
      const auto edge = [&](std::size_t k) {
        const auto lv = static_cast<std::size_t>(neighbors[(free + k) % 3]);
        return normalized(mesh.positions[hex[lv]] - origin);
      };
      held.push_back(
          {hex[static_cast<std::size_t>(neighbors[free])], cross(edge(1), edge(2)), corner.hex});
    }
  }

  QualityBound operator()(VertId v) const {
    QualityBound bound;
    if (!is_held[v]) return bound;
    std::vector<HeldCorner> held;
    for (const HexCorner& corner : vert_to_hex[v]) add_corner(corner, held, bound);
    std::stable_sort(held.begin(), held.end(),
                     [](const HeldCorner& a, const HeldCorner& b) { return a.free < b.free; });
    for (std::size_t begin = 0, end = 0; begin < held.size(); begin = end) {
      while (end < held.size() && held[end].free == held[begin].free) ++end;
      lower(bound, hull_distance(held, begin, end), held[begin].hex);
    }
    return bound;
  }
};

}  // namespace

QualityBound bound_quality(const HexMesh& mesh, const VertToHex& vert_to_hex,
                           const IdVector<VertId, char>& is_held) {
  const VertexBound bound_at{mesh, vert_to_hex, is_held};
  return parallel_reduce(
      mesh.num_verts(), QualityBound{},
      [&](std::size_t begin, std::size_t end) {
        QualityBound least;
        for (std::size_t v = begin; v < end; ++v) {
          const QualityBound b = bound_at(VertId(v));
          if (b.value < least.value) least = b;
        }
        return least;
      },
      [](const QualityBound& a, const QualityBound& b) { return b.value < a.value ? b : a; });
}

}  // namespace hexwright::relax
