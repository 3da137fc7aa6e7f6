// Point location in a tetrahedral mesh by a binary bounding volume hierarchy with median splits.
//
// Based on: Ericson, "Real-Time Collision Detection", 2005, sections 6.2 (object median) and 3.4
// (barycentric coordinates).
// Differs: points beside every positive tet are answered too, by the nearest of their facets, since
// maps in practice have flat tets at the polycube's edges and a vertex must land somewhere.
#include "polycube/tet_locator.h"

#include <algorithm>
#include <numeric>

#include "hexwright/base/error.h"

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

// Facet 4 * i + k is facet k of the i-th tet, which is how a hit leads back to its tet. Inner
// facets occur twice; the lower tet wins among equally near ones, as the surface tree promises.
TriMesh all_facets(const TetMesh& mesh, const std::vector<TetId>& tets) {
  TriMesh facets;
  facets.positions = mesh.positions;
  for (TetId t : tets)
    for (const auto& f : kFacets)
      facets.tris.push_back({mesh.tets[t][f[0]], mesh.tets[t][f[1]], mesh.tets[t][f[2]]});
  return facets;
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
  facets_ = std::make_unique<SurfaceTree>(all_facets(mesh, order_));
  build();
}

// Median split of the centres along the longest axis; ties by id, so that the tree is always the
// same.
void TetLocator::build() {
  const std::vector<TetId> facet_order = order_;
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(order_.size())});
  std::vector<std::uint32_t> stack = {0};
  while (!stack.empty()) {
    const std::uint32_t n = stack.back();
    stack.pop_back();
    const std::uint32_t first = nodes_[n].first, count = nodes_[n].count;
    Box3 box, centers;
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Box3 b = tet_box(mesh_, order_[i]);
      box.extend(b);
      centers.extend(b.center());
    }
    nodes_[n].box = box;
    if (count <= kLeafSize) continue;
    const Vec3 e = centers.extent();
    const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
    const std::uint32_t half = count / 2;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + half, begin + count, [&](TetId a, TetId b) {
      const double ca = tet_box(mesh_, a).center()[axis], cb = tet_box(mesh_, b).center()[axis];
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
  order_to_facet_owner_ = facet_order;
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

// The nearest facet of a positive tet; weights that rounding made negative are cut off, so that the
// result stays inside the tet.
TetPoint TetLocator::nearest(const Vec3& p) const {
  const auto hit = facets_->closest(p);
  const TetId tet = order_to_facet_owner_[hit->tri.index() / 4];
  TetPoint result{tet, barycentric(tet_corners(mesh_, tet), hit->point), true};
  double sum = 0;
  for (double& w : result.weight) sum += w = std::max(w, 0.0);
  for (double& w : result.weight) w /= sum;
  return result;
}

}  // namespace hexwright::polycube
