// Where the lattice lies, when the edge of its cells is given.
//
// Hexes stand around lattice points, so their faces lie on the mid-planes of cells: a plane of the
// part there is met as it is, whereas one through lattice points halves hexes, and which of them
// are kept is left to chance.
#include <algorithm>
#include <cmath>

#include "hexwright/base/error.h"
#include "hexwright/grid/size_field.h"

namespace hexwright {
namespace {

/// A part of the surface across an axis.
struct Plane {
  double at = 0;
  double area = 0;
};

/// Most planes that are considered as a pair, largest first.
constexpr std::size_t kMaxPlanes = 24;
/// Numbers of cells that are tried between two planes.
constexpr double kMostCounts = 8;
/// Cells are shortened to no less than this share.
constexpr double kLeastStretch = 0.75;
/// What shorter cells cost against area that meets the lattice.
constexpr double kPriceOfCells = 0.3;
/// Planes nearer than this, in cells, are one.
constexpr double kSamePlane = 1e-4;

/// Of the triangles across an axis, largest area first. `total` counts all triangles.
std::vector<Plane> find_planes(const TriMesh& surface, int axis, double edge, double& total) {
  constexpr double kAcross = 1 - 1e-9;
  std::vector<Plane> planes;
  total = 0;
  for (TriId t : surface.tris.ids()) {
    const auto p = surface.corners(t);
    const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
    const double twice = norm(n);
    total += twice / 2;
    if (std::abs(n[axis]) > kAcross * twice)
      planes.push_back({(p[0][axis] + p[1][axis] + p[2][axis]) / 3, twice / 2});
  }
  std::stable_sort(planes.begin(), planes.end(),
                   [](const Plane& a, const Plane& b) { return a.at < b.at; });
  std::vector<Plane> merged;
  for (const Plane& plane : planes) {
    if (!merged.empty() && plane.at - merged.back().at < kSamePlane * edge)
      merged.back().area += plane.area;
    else
      merged.push_back(plane);
  }
  std::stable_sort(merged.begin(), merged.end(),
                   [](const Plane& a, const Plane& b) { return a.area > b.area; });
  return merged;
}

/// A cell's edge along one axis and a plane between hexes.
struct Spacing {
  double edge = 0;
  double at = 0;
};

/// Share of the planes' area that meets the lattice: 1 on a plane between hexes, 0 half-way.
double score(const std::vector<Plane>& planes, const Spacing& s) {
  double sum = 0, area = 0;
  for (const Plane& plane : planes) {
    const double x = (plane.at - s.at) / s.edge;
    sum += plane.area * (1 - 2 * std::abs(x - std::round(x)));
    area += plane.area;
  }
  return area > 0 ? sum / area : 0;
}

Spacing choose_spacing(const std::vector<Plane>& all, double edge, double center) {
  const std::vector<Plane> planes(
      all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(kMaxPlanes, all.size())));
  Spacing best{edge, center};
  if (planes.empty()) return best;
  double most = -1;
  const auto consider = [&](const Spacing& s) {
    const double value = score(planes, s) - kPriceOfCells * (edge / s.edge - 1);
    if (value <= most + 1e-9) return;
    most = value;
    best = s;
  };
  for (const Plane& plane : planes) consider({edge, plane.at});
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      const double apart = std::abs(planes[j].at - planes[i].at);
      const double least = std::max(1.0, std::ceil(apart / edge - kSamePlane));
      for (double count = least;
           count < least + kMostCounts && apart / count >= kLeastStretch * edge; ++count)
        consider({std::min(edge, apart / count), planes[i].at});
    }
  return best;
}

}  // namespace

SizedDomain fit_lattice(const TriMesh& surface, double edge, double margin) {
  if (!(edge > 0) || !std::isfinite(edge))
    throw Error(ErrorCode::BadArgument, "the edge of cells must be positive");
  constexpr double kLeastShare = 0.02;  // of the surface, for its planes across an axis to count
  const Box3 box = bounding_box(surface);
  const Vec3 extent = box.extent(), center = box.center();
  const double room = margin * std::max({extent.x, extent.y, extent.z});
  std::array<Spacing, 3> spacing;
  double most_cells = 2;
  for (int a = 0; a < 3; ++a) {
    double total = 0, across = 0;
    std::vector<Plane> planes = find_planes(surface, a, edge, total);
    for (const Plane& plane : planes) across += plane.area;
    if (across < kLeastShare * total) planes.clear();
    const auto axis = static_cast<std::size_t>(a);
    spacing[axis] = choose_spacing(planes, edge, center[a]);
    // One more cell on each side: the root is moved by up to half of one.
    most_cells = std::max(most_cells, (extent[a] + 2 * room) / spacing[axis].edge + 2);
  }
  SizedDomain result;
  while (static_cast<double>(1 << result.level) < most_cells)
    if (++result.level > kMaxGridLevel)
      throw Error(ErrorCode::OutOfResources,
                  "cells of this edge are too small for the surface's size; ask for larger ones");
  const double num_cells = static_cast<double>(1 << result.level);
  GridFrame& frame = result.domain.frame;
  frame.root_size = edge * num_cells;
  for (int a = 0; a < 3; ++a) {
    const Spacing& s = spacing[static_cast<std::size_t>(a)];
    frame.stretch[a] = s.edge / edge;
    // The plane between hexes nearest to the middle stands half a cell beyond a lattice point.
    const double middle = s.at + std::round((center[a] - s.at) / s.edge) * s.edge;
    frame.origin[a] = middle + s.edge / 2 - s.edge * num_cells / 2;
  }
  result.domain.roots = {{0, 0, 0}};
  return result;
}

SizedDomain fill_box(const Box3& box, double edge, int least_roots) {
  const Vec3 extent = box.extent();
  const double shortest = std::min({extent.x, extent.y, extent.z});
  if (!(shortest > 0) || !(edge > 0) || !std::isfinite(norm(extent)) || !std::isfinite(edge))
    throw Error(ErrorCode::BadArgument, "a domain needs a box with room in it, and cells an edge");
  constexpr std::int64_t kMaxRoots = 1 << 20;
  SizedDomain result;
  GridFrame& frame = result.domain.frame;
  frame.origin = box.lo;
  frame.root_size = edge;
  while (frame.root_size * least_roots > shortest * (1 + 1e-9)) frame.root_size /= 2;
  while (2 * frame.root_size * least_roots <= shortest * (1 + 1e-9) &&
         result.level < kMaxGridLevel) {
    frame.root_size *= 2;
    ++result.level;
  }
  LatticeCoord count;
  std::int64_t num_roots = 1;
  for (int a = 0; a < 3; ++a) {
    const double cubes = std::ceil(extent[a] / frame.root_size - 1e-9);
    num_roots *= static_cast<std::int64_t>(std::min(cubes, 1e6));
    if (num_roots > kMaxRoots || cubes > 1000)
      throw Error(ErrorCode::OutOfResources,
                  "the box is too long for its least side: it would take more than 1000 root cubes "
                  "along an axis, or a million in all; make it wider or shorter");
    count[static_cast<std::size_t>(a)] = static_cast<std::int32_t>(std::max(1.0, cubes));
    frame.stretch[a] = std::min(1.0, extent[a] / (std::max(1.0, cubes) * frame.root_size));
  }
  for (LatticeCoord q = {0, 0, 0}; q[2] < count[2]; ++q[2])
    for (q[1] = 0; q[1] < count[1]; ++q[1])
      for (q[0] = 0; q[0] < count[0]; ++q[0]) result.domain.roots.push_back(q);
  return result;
}

}  // namespace hexwright
