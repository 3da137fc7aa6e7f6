#include "quality/topology/hanging_verts.h"

#include <algorithm>

#include "hexwright/base/parallel.h"

#include "geometry/tree/point_tree.h"

namespace hexwright {
namespace {

// Coordinates written with six digits still count as coinciding.
constexpr double kTolerance = 1e-5;

// Whether p is near the segment a b, away from its ends.
bool is_inside_edge(const Vec3& p, const Vec3& a, const Vec3& b, double tolerance) {
  const double length_sq = norm_sq(b - a);
  if (length_sq <= 4 * tolerance * tolerance) return false;
  const double t = dot(p - a, b - a) / length_sq;
  const double margin = tolerance / std::sqrt(length_sq);
  return t > margin && t < 1 - margin && norm_sq(p - (a + t * (b - a))) <= tolerance * tolerance;
}

// Whether p is near the triangle a b c; border included.
bool is_on_triangle(const Vec3& p, const std::array<Vec3, 3>& t, double tolerance) {
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const double area_sq = norm_sq(normal);
  if (!(area_sq > 0)) return false;
  if (std::abs(dot(p - t[0], normal)) > tolerance * std::sqrt(area_sq)) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (det(t[(k + 1) % 3] - t[k], p - t[k], normal) < -kTolerance * area_sq) return false;
  return true;
}

struct QuadShape {
  std::array<Vec3, 4> p;
  double tolerance = 0;

  QuadShape(const HexMesh& mesh, const std::array<VertId, 4>& quad) {
    Box3 box;
    for (std::size_t k = 0; k < 4; ++k) box.extend(p[k] = mesh.positions[quad[k]]);
    tolerance = kTolerance * box.diagonal();
  }

  Box3 search_box() const {
    Box3 box;
    for (const Vec3& x : p) box.extend(x);
    const Vec3 margin = {tolerance, tolerance, tolerance};
    return {box.lo - margin, box.hi + margin};
  }

  bool holds_inside(const Vec3& x) const {
    for (const Vec3& corner : p)
      if (norm_sq(x - corner) <= 4 * tolerance * tolerance) return false;
    for (std::size_t k = 0; k < 4; ++k)
      if (is_inside_edge(x, p[k], p[(k + 1) % 4], tolerance)) return true;
    const Vec3 center = (p[0] + p[1] + p[2] + p[3]) * 0.25;
    for (std::size_t k = 0; k < 4; ++k)
      if (is_on_triangle(x, {center, p[k], p[(k + 1) % 4]}, tolerance)) return true;
    return false;
  }
};

}  // namespace

std::vector<HangingVert> find_hanging_verts(const HexMesh& mesh, const BoundarySurface& boundary) {
  std::vector<Vec3> points;
  for (const BoundaryVert& v : boundary.verts) points.push_back(mesh.positions[v.vert]);
  const PointTree tree(std::move(points));
  const auto search_chunk = [&](std::size_t begin, std::size_t end) {
    std::vector<HangingVert> found;
    for (std::size_t q = begin; q < end; ++q) {
      const auto& quad = boundary.quads[q];
      const QuadShape shape(mesh, quad);
      tree.visit_box(shape.search_box(), [&](std::size_t i) {
        const VertId v = boundary.verts[i].vert;
        if (std::find(quad.begin(), quad.end(), v) == quad.end() &&
            shape.holds_inside(tree.points()[i]))
          found.push_back({v, boundary.faces[q]});
      });
    }
    return found;
  };
  const auto append = [](std::vector<HangingVert> a, const std::vector<HangingVert>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  auto hanging =
      parallel_reduce(boundary.quads.size(), std::vector<HangingVert>{}, search_chunk, append, 512);
  // Stable: the first face in the boundary's order stays the first of its vertex.
  std::stable_sort(hanging.begin(), hanging.end(),
                   [](const HangingVert& a, const HangingVert& b) { return a.vert < b.vert; });
  return hanging;
}

}  // namespace hexwright
