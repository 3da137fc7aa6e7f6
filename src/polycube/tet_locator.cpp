// Point location in a tetrahedral mesh by a binary bounding volume hierarchy with median splits.
//
// Based on: Ericson, "Real-Time Collision Detection", 2005, sections 6.2 (object median) and 3.4
// (barycentric coordinates).
// Differs: points beside every positive tet are answered too, by the nearest of their facets, since
// maps in practice have flat tets at the polycube's edges and a vertex must land somewhere.
#include "polycube/tet_locator.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"

namespace hexwright::polycube {
namespace {

// Below this the boxes cost more than the barycentric tests they spare.
constexpr std::uint32_t kLeafSize = 4;
// The facet opposite vertex k, counter-clockwise seen from outside a positive tet.
constexpr std::array<std::array<std::size_t, 3>, 4> kFacets = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

Box3 tet_box(const TetMesh& mesh, TetId t) {
  Box3 box;
  for (const Vec3& p : tet_corners(mesh, t)) box.extend(p);
  return box;
}

double distance_sq(const Box3& box, const Vec3& p) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double off = std::max({box.lo[axis] - p[axis], p[axis] - box.hi[axis], 0.0});
    sum += off * off;
  }
  return sum;
}

// Ericson, section 5.1.5: the Voronoi regions of the triangle's corners, then edges, then inside.
Vec3 closest_in_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const double d1 = dot(ab, p - a), d2 = dot(ac, p - a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = dot(ab, p - b), d4 = dot(ac, p - b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double d5 = dot(ab, p - c), d6 = dot(ac, p - c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return a + ab * (vb / sum) + ac * (vc / sum);
}

}  // namespace

double tet_det(const std::array<Vec3, 4>& p) { return det(p[1] - p[0], p[2] - p[0], p[3] - p[0]); }

std::size_t count_nonpositive(const TetMesh& mesh) {
  std::size_t count = 0;
  for (TetId t : mesh.tets.ids()) count += is_nonpositive(mesh, t);
  return count;
}

// Each weight is the volume of the tet with one vertex replaced by p. Taken as differences from p,
// so that the weights of a point near a vertex keep their digits far from the origin.
std::array<double, 4> barycentric(const std::array<Vec3, 4>& t, const Vec3& p) {
  const double volume = tet_det(t);
  const std::array<double, 4> weight = {
      det(t[1] - p, t[2] - p, t[3] - p) / volume, det(t[0] - p, t[3] - p, t[2] - p) / volume,
      det(t[0] - p, t[1] - p, t[3] - p) / volume, det(t[0] - p, t[2] - p, t[1] - p) / volume};
  return weight;
}

TetLocator::TetLocator(const TetMesh& mesh) : mesh_(mesh) {
  Box3 box;
  for (const Vec3& p : mesh.positions) box.extend(p);
  slack_ = 1e-9 * box.diagonal();
  // Flatter tets cannot be told from inverted ones: products of three coordinates carry that much
  // rounding.
  const double min_det = 1e-15 * box.diagonal() * box.diagonal() * box.diagonal();
  for (TetId t : mesh.tets.ids()) {
    if (tet_det(tet_corners(mesh, t)) > min_det)
      order_.push_back(t);
    else
      ++num_nonpositive_;
  }
  if (order_.empty())
    throw Error(ErrorCode::BadGeometry,
                "no tetrahedron of the polycube has a positive volume; check its vertex order");
  build();
}

// Median split of the centres along the longest axis; ties by id, so that the tree is always the
// same.
void TetLocator::build() {
  IdVector<TetId, Box3> boxes(mesh_.num_tets());
  IdVector<TetId, Vec3> centers_of(mesh_.num_tets());
  parallel_for(mesh_.num_tets(), [&](std::size_t t) {
    boxes[TetId(t)] = tet_box(mesh_, TetId(t));
    centers_of[TetId(t)] = boxes[TetId(t)].center();
  });
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(order_.size())});
  std::vector<std::uint32_t> stack = {0};
  while (!stack.empty()) {
    const std::uint32_t n = stack.back();
    stack.pop_back();
    const std::uint32_t first = nodes_[n].first, count = nodes_[n].count;
    Box3 box, centers;
    for (std::uint32_t i = first; i < first + count; ++i) {
      box.extend(boxes[order_[i]]);
      centers.extend(centers_of[order_[i]]);
    }
    nodes_[n].box = box;
    if (count <= kLeafSize) continue;
    const Vec3 e = centers.extent();
    const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
    const std::uint32_t half = count / 2;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + half, begin + count, [&](TetId a, TetId b) {
      const double ca = centers_of[a][axis], cb = centers_of[b][axis];
      return ca != cb ? ca < cb : a < b;
    });
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, first, half});
    nodes_.push_back({{}, first + half, count - half});
    nodes_[n].first = child;
    nodes_[n].count = 0;
    stack.push_back(child);
    stack.push_back(child + 1);
  }
}

TetPoint TetLocator::locate(const Vec3& p) const {
  // Barycentric: a point on a facet may be outside of both of its tets by rounding.
  constexpr double kOnFacet = -1e-9;
  TetPoint best;
  double depth = kOnFacet;
  const auto contains = [&](const Box3& b) {
    return p.x >= b.lo.x - slack_ && p.x <= b.hi.x + slack_ && p.y >= b.lo.y - slack_ &&
           p.y <= b.hi.y + slack_ && p.z >= b.lo.z - slack_ && p.z <= b.hi.z + slack_;
  };
  // Median splits: the depth is log2(number of tets), and every level leaves one node behind.
  std::array<std::uint32_t, 128> stack;
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = nodes_[stack[--top]];
    if (!contains(node.box)) continue;
    if (node.count == 0) {
      stack[top++] = node.first;
      stack[top++] = node.first + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const auto weight = barycentric(tet_corners(mesh_, order_[i]), p);
      const double least = *std::min_element(weight.begin(), weight.end());
      if (least > depth || (least == depth && best.tet.is_valid() && order_[i] < best.tet)) {
        depth = least;
        best = {order_[i], weight, false};
      }
    }
  }
  if (!best.tet.is_valid()) return nearest(p);
  double sum = 0;
  for (double& w : best.weight) sum += w = std::max(w, 0.0);
  for (double& w : best.weight) w /= sum;
  return best;
}

// The nearest facet of a positive tet, of the lowest tet among equally near ones; weights that
// rounding made negative are cut off, so that the result stays inside the tet.
TetPoint TetLocator::nearest(const Vec3& p) const {
  double best = std::numeric_limits<double>::infinity();
  TetId tet;
  Vec3 place;
  const auto try_tet = [&](TetId t) {
    const auto corners = tet_corners(mesh_, t);
    for (const auto& f : kFacets) {
      const Vec3 q = closest_in_triangle(p, corners[f[0]], corners[f[1]], corners[f[2]]);
      const double d = norm_sq(q - p);
      if (d > best || (d == best && !(t < tet))) continue;
      best = d;
      tet = t;
      place = q;
    }
  };
  std::array<std::pair<double, std::uint32_t>, 128> stack;
  std::size_t top = 0;
  stack[top++] = {distance_sq(nodes_[0].box, p), 0};
  while (top > 0) {
    const auto [near, n] = stack[--top];
    if (near > best) continue;
    const Node& node = nodes_[n];
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) try_tet(order_[i]);
    if (node.count > 0) continue;
    std::pair<double, std::uint32_t> a{distance_sq(nodes_[node.first].box, p), node.first};
    std::pair<double, std::uint32_t> b{distance_sq(nodes_[node.first + 1].box, p), node.first + 1};
    if (a < b) std::swap(a, b);  // the nearer one on top
    stack[top++] = a;
    stack[top++] = b;
  }
  TetPoint result{tet, barycentric(tet_corners(mesh_, tet), place), true};
  double sum = 0;
  for (double& w : result.weight) sum += w = std::max(w, 0.0);
  for (double& w : result.weight) w /= sum;
  return result;
}

}  // namespace hexwright::polycube
