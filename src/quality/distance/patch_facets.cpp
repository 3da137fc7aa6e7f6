#include "quality/distance/patch_facets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hexwright/base/parallel.h"
#include "hexwright/mesh/mid_nodes.h"

#include "geometry/tree/triangle_math.h"

namespace hexwright {
namespace {

/// A point of a bilinear patch and its facets at the same parameters differ by no more than this
/// share of p0 - p1 + p2 - p3: over the facet on one side, u (1 - s) / 4 with |u| <= s <= 1.
constexpr double kTwistShare = 1.0 / 16;

/// What of the twist takes patch and facets apart. Where both are graphs over one plane, a shift
/// along it leads to other points of both, and counts as the height that the facets gain over it.
double twist_error(const std::array<Vec3, 4>& p) {
  const Vec3 twist = p[0] - p[1] + p[2] - p[3];
  const double whole = kTwistShare * norm(twist);
  const Vec3 normal = normalized(cross(p[2] - p[0], p[3] - p[1]));
  const Vec3 center = 0.25 * (p[0] + p[1] + p[2] + p[3]);
  double cosine = 1;  // of the steepest facet
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 &a = p[k], &b = p[(k + 1) % 4], &c = p[(k + 2) % 4];
    if (!(det(b - a, c - b, normal) > 0)) return whole;  // not convex
    cosine = std::min(cosine, dot(normal, normalized(cross(b - a, center - a))));
  }
  if (!(cosine > 0.1)) return whole;
  const double rise = dot(twist, normal);
  const double slope = std::sqrt(std::max(0.0, 1 - cosine * cosine)) / cosine;
  const double along = norm(twist - rise * normal);
  return std::min(whole, kTwistShare * (std::abs(rise) + slope * along));
}

/// Linear interpolation on a triangle in a circle of radius R errs by at most R^2 / 2 times the
/// largest second derivative in any direction (Waldron, "The error in linear interpolation at the
/// vertices of a simplex", SIAM J. Numer. Anal. 35, 1998). Those of a serendipity patch are linear
/// in each parameter: largest at corners, and exact by differences.
double curved_error(const QuadraticQuad& quad) {
  constexpr double kRadius = 0.5, kStep = 0.5;
  const auto f = [&](double u, double v) { return point_on(quad, u, v); };
  double largest = 0;
  for (const double u : {0.0, 1.0})
    for (const double v : {0.0, 1.0}) {
      const Vec3 uu = 4 * (f(0, v) - 2 * f(0.5, v) + f(1, v));
      const Vec3 vv = 4 * (f(u, 0) - 2 * f(u, 0.5) + f(u, 1));
      const Vec3 uv = f(u + kStep, v + kStep) - f(u + kStep, v - kStep) - f(u - kStep, v + kStep) +
                      f(u - kStep, v - kStep);  // (2 kStep)^2 = 1
      largest = std::max(largest, std::max(norm(uu), norm(vv)) + norm(uv));
    }
  return kRadius * kRadius / 2 * largest;
}

double distance_to_triangle(const Vec3& p, const std::array<Vec3, 3>& t) {
  const TriangleData data = TriangleData::make(t[0], t[1], t[2], {});
  return distance(p - data.a, closest_offset(data, p - data.a));
}

}  // namespace

QuadPatches::QuadPatches(const HexMesh& mesh, const std::vector<std::array<VertId, 4>>& quads)
    : mesh_(mesh), quads_(quads), error_(quads.size()) {
  if (mesh.mid_nodes) {
    const EdgeTable edges(mesh);
    curved_.resize(quads.size());
    parallel_for(quads.size(),
                 [&](std::size_t q) { curved_[q] = quadratic_quad(mesh, edges, quads[q]); });
  }
  parallel_for(quads.size(), [&](std::size_t q) {
    const auto& v = quads_[q];
    error_[q] = curved_.empty() ? twist_error({mesh.positions[v[0]], mesh.positions[v[1]],
                                               mesh.positions[v[2]], mesh.positions[v[3]]})
                                : curved_error(curved_[q]);
  });
}

Vec3 QuadPatches::point(std::size_t quad, double u, double v) const {
  if (!curved_.empty()) return point_on(curved_[quad], u, v);
  const auto& q = quads_[quad];
  const auto& p = mesh_.positions;
  return (1 - v) * ((1 - u) * p[q[0]] + u * p[q[1]]) + v * ((1 - u) * p[q[3]] + u * p[q[2]]);
}

int QuadPatches::divisions_for(std::size_t quad, double error, int most) const {
  const double needed = std::ceil(std::sqrt(error_[quad] / error));
  return static_cast<int>(std::clamp(needed, 1.0, static_cast<double>(most)));
}

void QuadPatches::append_facets(std::size_t quad, int divisions, TriMesh& triangles) const {
  const int first = static_cast<int>(triangles.num_verts()), row = divisions + 1;
  const double n = divisions;
  for (int j = 0; j < row; ++j)
    for (int i = 0; i < row; ++i) triangles.positions.push_back(point(quad, i / n, j / n));
  for (int j = 0; j < divisions; ++j)
    for (int i = 0; i < divisions; ++i) {
      const VertId center =
          triangles.positions.push_back(point(quad, (i + 0.5) / n, (j + 0.5) / n));
      const int at = first + j * row + i;
      const std::array<VertId, 4> corners = {VertId(at), VertId(at + 1), VertId(at + row + 1),
                                             VertId(at + row)};
      for (std::size_t k = 0; k < 4; ++k)
        triangles.tris.push_back({corners[k], corners[(k + 1) % 4], center});
    }
}

QuadPatches::PointBounds QuadPatches::bound_distance(const Vec3& p, double gap) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr int kMostDivisions = 256;
  std::vector<std::size_t> open(size());
  for (std::size_t q = 0; q < size(); ++q) open[q] = q;
  PointBounds bounds = {0, kInfinity, 0};
  for (int divisions = 1; divisions <= kMostDivisions; divisions *= 4) {
    std::vector<double> to_facets(open.size());
    parallel_for(
        open.size(),
        [&](std::size_t i) { to_facets[i] = distance_to_facets(open[i], divisions, p); }, 256);
    bounds.lower = kInfinity;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const double error = facet_error(open[i], divisions);
      bounds.lower = std::min(bounds.lower, std::max(0.0, to_facets[i] - error));
      if (to_facets[i] + error >= bounds.upper) continue;
      bounds.upper = to_facets[i] + error;
      bounds.nearest = open[i];
    }
    bounds.lower = std::min(bounds.lower, bounds.upper);
    if (bounds.upper - bounds.lower <= gap) break;
    std::vector<std::size_t> rest;
    for (std::size_t i = 0; i < open.size(); ++i)
      if (to_facets[i] - facet_error(open[i], divisions) < bounds.upper) rest.push_back(open[i]);
    open = std::move(rest);
  }
  return bounds;
}

double QuadPatches::distance_to_facets(std::size_t quad, int divisions, const Vec3& p) const {
  TriMesh facets;
  append_facets(quad, divisions, facets);
  double nearest = std::numeric_limits<double>::infinity();
  for (TriId t : facets.tris.ids())
    nearest = std::min(nearest, distance_to_triangle(p, facets.corners(t)));
  return nearest;
}

PatchFacets make_facets(const QuadPatches& patches, const std::vector<int>& divisions) {
  PatchFacets facets;
  for (std::size_t q = 0; q < patches.size(); ++q) {
    if (divisions[q] == 0) continue;
    patches.append_facets(q, divisions[q], facets.triangles);
    facets.tri_to_quad.resize(facets.triangles.num_tris(), static_cast<std::int32_t>(q));
    facets.tri_error.resize(facets.triangles.num_tris(), patches.facet_error(q, divisions[q]));
  }
  return facets;
}

}  // namespace hexwright
