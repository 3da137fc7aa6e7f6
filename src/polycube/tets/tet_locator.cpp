// Point location in a tetrahedral mesh.
//
// Based on: Ericson, "Real-Time Collision Detection", 2005, section 3.4 (barycentric coordinates).
// Differs: points beside every positive tet are answered too, by the nearest of their facets, since
// maps in practice have flat tets at the polycube's edges and a vertex must land somewhere.
#include "polycube/tets/tet_locator.h"

#include <algorithm>
#include <limits>

#include "hexwright/base/error.h"

#include "geometry/tree/triangle_math.h"

namespace hexwright::polycube {
namespace {

// The facet opposite vertex k, counter-clockwise seen from outside a positive tet.
constexpr std::array<std::array<std::size_t, 3>, 4> kFacets = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

Box3 tet_box(const TetMesh& mesh, TetId t) {
  Box3 box;
  for (const Vec3& p : tet_corners(mesh, t)) box.extend(p);
  return box;
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
  const double six_volumes = tet_det(t);
  const std::array<double, 4> weight = {det(t[1] - p, t[2] - p, t[3] - p) / six_volumes,
                                        det(t[0] - p, t[3] - p, t[2] - p) / six_volumes,
                                        det(t[0] - p, t[1] - p, t[3] - p) / six_volumes,
                                        det(t[0] - p, t[2] - p, t[1] - p) / six_volumes};
  return weight;
}

std::array<Vec3, 4> barycentric_gradients(const std::array<Vec3, 4>& t) {
  const double six_volumes = tet_det(t);
  std::array<Vec3, 4> gradients;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& f = kFacets[k];
    gradients[k] = cross(t[f[2]] - t[f[0]], t[f[1]] - t[f[0]]) / six_volumes;
  }
  return gradients;
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
      tets_.push_back(t);
    else
      ++num_nonpositive_;
  }
  if (tets_.empty())
    throw Error(ErrorCode::BadGeometry,
                "no tetrahedron of the polycube has a positive volume; check its vertex order");
  std::vector<Box3> boxes;
  boxes.reserve(tets_.size());
  for (TetId t : tets_) boxes.push_back(tet_box(mesh, t));
  tree_ = BoxTree(boxes);
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
  tree_.visit(contains, [&](BoxTree::Item i) {
    const TetId t = tets_[i];
    const auto weight = barycentric(tet_corners(mesh_, t), p);
    const double least = *std::min_element(weight.begin(), weight.end());
    if (least > depth || (least == depth && best.tet.is_valid() && t < best.tet)) {
      depth = least;
      best = {t, weight, false};
    }
  });
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
  tree_.visit_nearest(p, [&](BoxTree::Item i) {
    const auto corners = tet_corners(mesh_, tets_[i]);
    for (const auto& f : kFacets) {
      const Vec3& a = corners[f[0]];
      const auto facet = TriangleData::make(a, corners[f[1]], corners[f[2]], {});
      const Vec3 q = a + closest_offset(facet, p - a);
      const double d = norm_sq(q - p);
      if (d > best || (d == best && !(tets_[i] < tet))) continue;
      best = d;
      tet = tets_[i];
      place = q;
    }
    return best;
  });
  TetPoint result{tet, barycentric(tet_corners(mesh_, tet), place), true};
  double sum = 0;
  for (double& w : result.weight) sum += w = std::max(w, 0.0);
  for (double& w : result.weight) w /= sum;
  return result;
}

}  // namespace hexwright::polycube
