// Charts are grown over facets of equal direction; each axis is then mapped piecewise linearly so
// that its planes land on integers. Two planes never fall together, however thin the part between
// them.
//
// Based on: Pitzalis et al. 2021, section 6.2.
// Differs: planes keep their own distances, as the nearest number of cubes of the spacing.
#include "polycube/lattice.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "hexwright/base/error.h"
#include "hexwright/geometry/surface_tree.h"

#include "polycube/merge_charts.h"
#include "polycube/tet_boundary.h"

namespace hexwright::polycube {
namespace {

constexpr double kAlignedCosine = 0.94;   // facets within 20 degrees of an axis are aligned
constexpr double kNegligibleArea = 1e-2;  // share of the boundary that may be unaligned
constexpr double kSamePlane = 2e-2;       // planes closer than this share of the extent are one
constexpr double kLargestDeviation =
    0.25;                              // of a vertex from its chart's plane, share of the spacing
constexpr int kMostCubesPerAxis = 16;  // of a derived spacing

struct FacetGeometry {
  Vec3 normal;  // area vector
  Vec3 center;
};

FacetGeometry facet_geometry(const TetMesh& mesh, const std::array<VertId, 3>& f) {
  const Vec3 &a = mesh.positions[f[0]], &b = mesh.positions[f[1]], &c = mesh.positions[f[2]];
  return {cross(b - a, c - a) * 0.5, (a + b + c) / 3.0};
}

// 0..5 = 2 * axis + (faces up), or -1 when the facet faces no axis.
int facet_direction(const Vec3& area_vector) {
  const Vec3 n = normalized(area_vector);
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(n[axis]) > kAlignedCosine) return 2 * axis + (n[axis] > 0 ? 1 : 0);
  return -1;
}

// The up to three facets across the edges of each boundary facet (the lowest id where an edge has
// more).
IdVector<TriId, std::array<TriId, 3>> facet_neighbors(
    const IdVector<TriId, std::array<VertId, 3>>& facets) {
  std::unordered_map<std::uint64_t, std::vector<std::pair<TriId, int>>> by_edge;
  const auto key = [](VertId a, VertId b) {
    const auto lo = static_cast<std::uint64_t>(std::min(a, b).value());
    return lo << 32 | static_cast<std::uint64_t>(std::max(a, b).value());
  };
  for (TriId t : facets.ids())
    for (int k = 0; k < 3; ++k)
      by_edge[key(facets[t][k], facets[t][(k + 1) % 3])].push_back({t, k});
  IdVector<TriId, std::array<TriId, 3>> neighbor(facets.size());
  for (TriId t : facets.ids())
    for (int k = 0; k < 3; ++k)
      for (const auto& [other, side] : by_edge[key(facets[t][k], facets[t][(k + 1) % 3])])
        if (other != t && !neighbor[t][k].is_valid()) neighbor[t][k] = other;
  return neighbor;
}

// Unaligned facets take the direction of an aligned neighbour; refuses when they are too much of
// the boundary.
IdVector<TriId, int> facet_directions(const Lattice& lattice, std::size_t& num_unaligned,
                                      const IdVector<TriId, std::array<TriId, 3>>& neighbor) {
  IdVector<TriId, int> direction(lattice.facets.size(), -1);
  double area = 0, unaligned_area = 0;
  TriId first_unaligned;
  for (TriId t : lattice.facets.ids()) {
    const Vec3 n = facet_geometry(lattice.tets, lattice.facets[t]).normal;
    direction[t] = facet_direction(n);
    area += norm(n);
    if (direction[t] >= 0) continue;
    ++num_unaligned;
    unaligned_area += norm(n);
    if (!first_unaligned.is_valid()) first_unaligned = t;
  }
  if (unaligned_area > kNegligibleArea * area) {
    const auto& f = lattice.facets[first_unaligned];
    throw Error(ErrorCode::BadGeometry,
                "the polycube's boundary is not axis-aligned: " + std::to_string(num_unaligned) +
                    " of " + std::to_string(lattice.facets.size()) + " facets, first facet " +
                    std::to_string(first_unaligned.value()) + " (vertices " +
                    std::to_string(f[0].value() + 1) + " " + std::to_string(f[1].value() + 1) +
                    " " + std::to_string(f[2].value() + 1) +
                    "); pass the polycube as the second mesh, deformed until its faces are flat");
  }
  for (std::size_t left = num_unaligned, before = 0; left != before && left > 0;) {
    before = left;
    for (TriId t : lattice.facets.ids())
      for (TriId other : neighbor[t])
        if (direction[t] < 0 && other.is_valid() && direction[other] >= 0) {
          direction[t] = direction[other];
          --left;
        }
  }
  return direction;
}

// Flood fill over facets of equal direction that share an edge. A direction of -1 (unaligned,
// without an aligned neighbour) cannot occur but in a component made of such facets alone.
void grow_charts(Lattice& lattice, const IdVector<TriId, int>& direction,
                 const IdVector<TriId, std::array<TriId, 3>>& neighbor) {
  lattice.facet_to_chart.assign(lattice.facets.size(), -1);
  for (TriId seed : lattice.facets.ids()) {
    if (lattice.facet_to_chart[seed] >= 0) continue;
    const int chart = static_cast<int>(lattice.charts.size());
    const Chart c{std::max(direction[seed], 0) / 2, direction[seed] % 2 == 1 ? 1 : -1, 0, 0};
    std::vector<TriId> stack = {seed};
    lattice.facet_to_chart[seed] = chart;
    while (!stack.empty()) {
      const TriId t = stack.back();
      stack.pop_back();
      for (TriId other : neighbor[t])
        if (other.is_valid() && lattice.facet_to_chart[other] < 0 &&
            direction[other] == direction[seed]) {
          lattice.facet_to_chart[other] = chart;
          stack.push_back(other);
        }
    }
    lattice.charts.push_back(c);
  }
}

// The area-weighted mean of each chart's facets along its axis.
void measure_coordinates(Lattice& lattice) {
  std::vector<double> area(lattice.charts.size(), 0);
  for (Chart& chart : lattice.charts) chart.coordinate = 0;
  for (TriId t : lattice.facets.ids()) {
    const auto c = static_cast<std::size_t>(lattice.facet_to_chart[t]);
    Chart& chart = lattice.charts[c];
    const auto g = facet_geometry(lattice.tets, lattice.facets[t]);
    const double a = std::abs(g.normal[chart.axis]);
    area[c] += a;
    chart.coordinate += a * g.center[chart.axis];
  }
  for (std::size_t c = 0; c < area.size(); ++c)
    if (area[c] > 0) lattice.charts[c].coordinate /= area[c];
}

// Distinct plane coordinates of an axis, ascending.
std::vector<double> axis_planes(const std::vector<Chart>& charts, int axis, double merge) {
  std::vector<double> all, planes;
  for (const Chart& c : charts)
    if (c.axis == axis) all.push_back(c.coordinate);
  std::sort(all.begin(), all.end());
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    double sum = 0;
    while (end < all.size() && all[end] - all[begin] <= merge) sum += all[end++];
    planes.push_back(sum / static_cast<double>(end - begin));
  }
  return planes;
}

using AxisPlanes = std::array<std::vector<double>, 3>;

AxisPlanes find_planes(Lattice& lattice, double extent) {
  measure_coordinates(lattice);
  AxisPlanes planes;
  for (int axis = 0; axis < 3; ++axis) {
    planes[axis] = axis_planes(lattice.charts, axis, kSamePlane * extent);
    if (planes[axis].size() < 2)
      throw Error(ErrorCode::BadGeometry, "the polycube has no two faces across axis " +
                                              std::to_string(axis) + "; it encloses no volume");
  }
  return planes;
}

// The closest two planes get one cube between them, but an extent of more than 16 cubes is left to
// the adaptive refinement: roots are for topology, not for resolution.
double derive_spacing(const AxisPlanes& planes, double extent) {
  double least = extent;
  for (const auto& p : planes)
    for (std::size_t i = 1; i < p.size(); ++i) least = std::min(least, p[i] - p[i - 1]);
  return std::max(least, extent / kMostCubesPerAxis);
}

// The first plane is 0. Neighbouring planes differ by at least one, so nothing between two
// of them collapses on the lattice.
std::vector<int> integer_planes(const std::vector<double>& planes, double spacing) {
  std::vector<int> result(planes.size(), 0);
  for (std::size_t i = 1; i < planes.size(); ++i)
    result[i] = result[i - 1] +
                std::max(1, static_cast<int>(std::lround((planes[i] - planes[i - 1]) / spacing)));
  return result;
}

// Piecewise linear through (planes[i], integers[i]), with slope 1/spacing beyond the ends.
double to_lattice(double x, const std::vector<double>& planes, const std::vector<int>& integers,
                  double spacing) {
  if (x <= planes.front()) return integers.front() + (x - planes.front()) / spacing;
  if (x >= planes.back()) return integers.back() + (x - planes.back()) / spacing;
  const auto i =
      static_cast<std::size_t>(std::upper_bound(planes.begin(), planes.end(), x) - planes.begin());
  const double t = (x - planes[i - 1]) / (planes[i] - planes[i - 1]);
  return integers[i - 1] + t * (integers[i] - integers[i - 1]);
}

std::size_t nearest_plane(const std::vector<double>& planes, double x) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < planes.size(); ++i)
    if (std::abs(planes[i] - x) < std::abs(planes[best] - x)) best = i;
  return best;
}

// Puts each chart's vertices exactly on its integer plane, measuring how far they were.
// Vertices shared by charts of two axes are put on both planes, since each sets its own coordinate.
void flatten_charts(Lattice& lattice) {
  for (TriId t : lattice.facets.ids()) {
    const Chart& chart = lattice.charts[static_cast<std::size_t>(lattice.facet_to_chart[t])];
    for (VertId v : lattice.facets[t]) {
      double& x = lattice.tets.positions[v][chart.axis];
      const double deviation = std::abs(x - chart.plane);
      if (deviation > kLargestDeviation)
        throw Error(ErrorCode::BadGeometry,
                    "the polycube's boundary is not flat: facet " + std::to_string(t.value()) +
                        " is " + std::to_string(deviation) +
                        " root cubes off its plane; flatten the polycube or give a larger spacing");
      lattice.max_deviation = std::max(lattice.max_deviation, deviation);
      x = chart.plane;
    }
  }
}

// Centres of lattice cubes are half a cube away from every plane: the winding number is never asked
// near the boundary.
void collect_roots(Lattice& lattice, const std::array<int, 3>& size) {
  TriMesh boundary;
  boundary.positions = lattice.tets.positions;
  boundary.tris = lattice.facets;
  const SurfaceTree tree(boundary);
  for (int z = 0; z < size[2]; ++z)
    for (int y = 0; y < size[1]; ++y)
      for (int x = 0; x < size[0]; ++x)
        if (tree.is_inside({x + 0.5, y + 0.5, z + 0.5})) lattice.roots.push_back({x, y, z});
  if (lattice.roots.empty())
    throw Error(ErrorCode::BadGeometry,
                "no lattice cube lies inside the polycube; give a smaller spacing");
}

}  // namespace

Lattice fit_lattice(const TetMesh& polycube, double spacing) {
  Lattice lattice;
  lattice.tets = polycube;
  lattice.facets = boundary_facets(polycube);
  const auto neighbor = facet_neighbors(lattice.facets);
  const auto direction = facet_directions(lattice, lattice.num_unaligned, neighbor);
  grow_charts(lattice, direction, neighbor);

  Box3 box;
  for (const Vec3& p : polycube.positions) box.extend(p);
  const Vec3 e = box.extent();
  const double extent = std::max({e.x, e.y, e.z});
  AxisPlanes planes = find_planes(lattice, extent);
  lattice.spacing = spacing > 0 ? spacing : derive_spacing(planes, extent);
  lattice.num_merged_charts = merge_small_charts(lattice, neighbor, lattice.spacing);
  if (lattice.num_merged_charts > 0) {
    planes = find_planes(lattice, extent);
    if (spacing <= 0) lattice.spacing = derive_spacing(planes, extent);
  }

  std::array<std::vector<int>, 3> integers;
  std::array<int, 3> size;
  for (int axis = 0; axis < 3; ++axis) {
    integers[axis] = integer_planes(planes[axis], lattice.spacing);
    size[axis] = integers[axis].back();
  }
  for (Chart& chart : lattice.charts)
    chart.plane = integers[chart.axis][nearest_plane(planes[chart.axis], chart.coordinate)];
  for (Vec3& p : lattice.tets.positions)
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = to_lattice(p[axis], planes[axis], integers[axis], lattice.spacing);
  flatten_charts(lattice);
  collect_roots(lattice, size);
  return lattice;
}

}  // namespace hexwright::polycube
