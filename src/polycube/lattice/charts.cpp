// Charts are grown over facets of equal direction.
//
// Based on: Pitzalis et al. 2021, section 6.2.
// Differs: a boundary that is not quite flat is put right up to a share.
#include "polycube/lattice/charts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "hexwright/base/error.h"

#include "polycube/lattice/merge_charts.h"
#include "polycube/tets/tet_boundary.h"

namespace hexwright::polycube {
namespace {

constexpr double kAlignedCosine = 0.94;  // facets within 20 degrees of an axis are aligned
// Facets of an uneven face, up to 41 degrees from its axis, belong to it where they join it.
constexpr double kLeaningCosine = 0.75;
constexpr double kNegligibleArea = 1e-2;  // share of the boundary that may be unaligned
constexpr double kSamePlane = 2e-2;       // of the extent: what may be one plane
// What a vertex may be off its chart's plane: this share of the way to the next plane, or this
// share of the extent, whichever is more.
constexpr double kSnapToNext = 0.25, kSnapOfExtent = 0.02;

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

double cosine_to(const Vec3& unit_normal, int direction) {
  return unit_normal[direction / 2] * (direction % 2 == 1 ? 1 : -1);
}

// Gives facets without a direction that of a neighbour, the one they face most, as long as they
// face it by `least` or more; over and over.
void adopt_directions(const IdVector<TriId, Vec3>& normals, double least,
                      const IdVector<TriId, std::array<TriId, 3>>& neighbor,
                      IdVector<TriId, int>& direction) {
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (TriId t : direction.ids()) {
      if (direction[t] >= 0) continue;
      double best = least;
      for (TriId other : neighbor[t])
        if (other.is_valid() && direction[other] >= 0 &&
            cosine_to(normals[t], direction[other]) >= best) {
          best = cosine_to(normals[t], direction[other]);
          direction[t] = direction[other];
          is_changed = true;
        }
    }
  }
}

[[noreturn]] void refuse_unaligned(const Lattice& lattice, std::size_t count, TriId first) {
  const auto& f = lattice.facets[first];
  throw Error(ErrorCode::BadGeometry,
              "the polycube's boundary is not axis-aligned: " + std::to_string(count) + " of " +
                  std::to_string(lattice.facets.size()) + " facets, first facet " +
                  std::to_string(first.value()) + " (vertices " + std::to_string(f[0].value() + 1) +
                  " " + std::to_string(f[1].value() + 1) + " " + std::to_string(f[2].value() + 1) +
                  "); pass the polycube as the second mesh, deformed until its faces are flat");
}

// Facets near an axis have its direction; leaning ones that of a neighbour that they nearly face;
// the rest that of any neighbour. Refuses when the rest is too much of the boundary.
IdVector<TriId, int> facet_directions(const Lattice& lattice, std::size_t& num_unaligned,
                                      const IdVector<TriId, std::array<TriId, 3>>& neighbor) {
  IdVector<TriId, int> direction(lattice.facets.size(), -1);
  IdVector<TriId, Vec3> normals(lattice.facets.size());
  IdVector<TriId, double> areas(lattice.facets.size());
  double area = 0, unaligned_area = 0;
  for (TriId t : lattice.facets.ids()) {
    const Vec3 n = facet_geometry(lattice.tets, lattice.facets[t]).normal;
    areas[t] = norm(n);
    area += areas[t];
    normals[t] = normalized(n);
    direction[t] = facet_direction(n);
  }
  adopt_directions(normals, kLeaningCosine, neighbor, direction);
  TriId first_unaligned;
  for (TriId t : lattice.facets.ids()) {
    if (direction[t] >= 0) continue;
    ++num_unaligned;
    unaligned_area += areas[t];
    if (!first_unaligned.is_valid()) first_unaligned = t;
  }
  if (unaligned_area > kNegligibleArea * area)
    refuse_unaligned(lattice, num_unaligned, first_unaligned);
  adopt_directions(normals, -2, neighbor, direction);
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

// The facets that run along an axis, by how much of it each covers.
class Walls {
 public:
  Walls(const Lattice& lattice, int axis) {
    for (TriId t : lattice.facets.ids()) {
      if (lattice.charts[static_cast<std::size_t>(lattice.facet_to_chart[t])].axis == axis)
        continue;
      Wall wall{lattice.tets.positions[lattice.facets[t][0]][axis], 0, 0};
      wall.high = wall.low;
      for (VertId v : lattice.facets[t]) {
        wall.low = std::min(wall.low, lattice.tets.positions[v][axis]);
        wall.high = std::max(wall.high, lattice.tets.positions[v][axis]);
      }
      wall.area = norm(facet_geometry(lattice.tets, lattice.facets[t]).normal);
      walls_.push_back(wall);
    }
  }

  // Whether there are walls from one coordinate to the other and no further: a step of the
  // polycube, which would collapse if the two were made one.
  bool is_step(double low, double high) const {
    const double gap = high - low, slack = 0.25 * gap;
    double area = 0;
    for (const Wall& w : walls_)
      if (w.low >= low - slack && w.high <= high + slack && w.high - w.low > 0.5 * gap)
        area += w.area;
    return area > 0.25 * gap * gap;
  }

 private:
  struct Wall {
    double low, high, area;
  };
  std::vector<Wall> walls_;
};

// Distinct plane coordinates of an axis, ascending. Charts that were deformed apart from each other
// stand for one plane when they are near and no step lies between them.
std::vector<double> axis_planes(const Lattice& lattice, int axis, double merge) {
  std::vector<double> all, planes;
  for (const Chart& c : lattice.charts)
    if (c.axis == axis) all.push_back(c.coordinate);
  std::sort(all.begin(), all.end());
  const double same = 1e-9 * merge / kSamePlane;
  const Walls walls(lattice, axis);
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    double sum = 0;
    while (end < all.size() &&
           (all[end] - all[begin] <= same ||
            (all[end] - all[begin] <= merge &&
             (all[end] - all[end - 1] <= same || !walls.is_step(all[begin], all[end])))))
      sum += all[end++];
    planes.push_back(sum / static_cast<double>(end - begin));
  }
  return planes;
}

AxisPlanes find_planes(Lattice& lattice, double extent) {
  measure_coordinates(lattice);
  AxisPlanes planes;
  for (int axis = 0; axis < 3; ++axis) {
    auto& p = planes[static_cast<std::size_t>(axis)];
    p = axis_planes(lattice, axis, kSamePlane * extent);
    if (p.size() < 2)
      throw Error(ErrorCode::BadGeometry, "the polycube has no two faces across axis " +
                                              std::to_string(axis) + "; it encloses no volume");
  }
  return planes;
}

std::size_t nearest_plane(const std::vector<double>& planes, double x) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < planes.size(); ++i)
    if (std::abs(planes[i] - x) < std::abs(planes[best] - x)) best = i;
  return best;
}

double least_gap(const AxisPlanes& planes) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& p : planes)
    for (std::size_t i = 1; i < p.size(); ++i) least = std::min(least, p[i] - p[i - 1]);
  return least;
}

double gap_beside(const std::vector<double>& planes, std::size_t i) {
  double gap = std::numeric_limits<double>::infinity();
  if (i > 0) gap = planes[i] - planes[i - 1];
  if (i + 1 < planes.size()) gap = std::min(gap, planes[i + 1] - planes[i]);
  return gap;
}

// Puts each chart's vertices exactly on its plane, measuring how far they were.
// Vertices shared by charts of two axes are put on both planes, since each sets its own coordinate.
void flatten_charts(Faces& faces) {
  Lattice& lattice = faces.lattice;
  for (TriId t : lattice.facets.ids()) {
    const auto number = static_cast<std::size_t>(lattice.facet_to_chart[t]);
    const Chart& chart = lattice.charts[number];
    const auto& planes = faces.planes[static_cast<std::size_t>(chart.axis)];
    const std::size_t plane = faces.chart_plane[number];
    const double allowed =
        std::max(kSnapToNext * gap_beside(planes, plane), kSnapOfExtent * faces.extent);
    for (VertId v : lattice.facets[t]) {
      double& x = lattice.tets.positions[v][chart.axis];
      const double deviation = std::abs(x - planes[plane]);
      if (deviation > allowed) {
        const auto& f = lattice.facets[t];
        throw Error(ErrorCode::BadGeometry,
                    "the polycube's boundary is not flat: facet " + std::to_string(t.value()) +
                        " (vertices " + std::to_string(f[0].value() + 1) + " " +
                        std::to_string(f[1].value() + 1) + " " + std::to_string(f[2].value() + 1) +
                        ") is " + std::to_string(deviation) + " off its plane, more than " +
                        std::to_string(allowed) +
                        ", a quarter of the way to the next plane or 2% of the extent; flatten it");
      }
      lattice.max_deviation = std::max(lattice.max_deviation, deviation);
      x = planes[plane];
    }
  }
}

}  // namespace

Faces find_faces(const TetMesh& polycube, double spacing) {
  Faces faces;
  Lattice& lattice = faces.lattice;
  lattice.tets = polycube;
  lattice.facets = boundary_facets(polycube);
  const auto neighbor = facet_neighbors(lattice.facets);
  const auto direction = facet_directions(lattice, lattice.num_unaligned, neighbor);
  grow_charts(lattice, direction, neighbor);

  Box3 box;
  for (const Vec3& p : polycube.positions) box.extend(p);
  const Vec3 e = box.extent();
  faces.extent = std::max({e.x, e.y, e.z});
  faces.planes = find_planes(lattice, faces.extent);
  lattice.num_merged_charts =
      merge_small_charts(lattice, neighbor, spacing > 0 ? spacing : least_gap(faces.planes));
  if (lattice.num_merged_charts > 0) faces.planes = find_planes(lattice, faces.extent);
  for (const Chart& chart : lattice.charts)
    faces.chart_plane.push_back(
        nearest_plane(faces.planes[static_cast<std::size_t>(chart.axis)], chart.coordinate));
  flatten_charts(faces);
  return faces;
}

}  // namespace hexwright::polycube
