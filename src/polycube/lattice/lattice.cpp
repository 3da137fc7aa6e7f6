// Each axis is mapped by its scale, which takes planes to integers. Two planes never fall together,
// however thin the part between them.
//
// Based on: Pitzalis et al. 2021, section 6.2.
// Differs: planes need not lie on a lattice; each axis is stretched between them.
#include "polycube/lattice/lattice.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "hexwright/base/error.h"
#include "hexwright/geometry/surface_tree.h"

#include "polycube/lattice/charts.h"

namespace hexwright::polycube {
namespace {

// A box between neighbouring planes of each axis; `high` is not in it.
struct LatticeBox {
  std::array<int, 3> low, high;
  std::size_t num_cubes() const {
    std::size_t count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
      count *= static_cast<std::size_t>(high[axis] - low[axis]);
    return count;
  }
};

// A box is inside or outside as a whole, and its centre is far from every plane: the winding number
// is never asked near the boundary.
std::vector<LatticeBox> boxes_inside(const Lattice& lattice,
                                     const std::array<std::vector<int>, 3>& planes) {
  TriMesh boundary;
  boundary.positions = lattice.tets.positions;
  boundary.tris = lattice.facets;
  const SurfaceTree tree(boundary);
  std::vector<LatticeBox> boxes;
  for (std::size_t k = 0; k + 1 < planes[2].size(); ++k)
    for (std::size_t j = 0; j + 1 < planes[1].size(); ++j)
      for (std::size_t i = 0; i + 1 < planes[0].size(); ++i) {
        const LatticeBox box{{planes[0][i], planes[1][j], planes[2][k]},
                             {planes[0][i + 1], planes[1][j + 1], planes[2][k + 1]}};
        Vec3 center;
        for (int axis = 0; axis < 3; ++axis) {
          const auto a = static_cast<std::size_t>(axis);
          center[axis] = (box.low[a] + box.high[a]) / 2.0;
        }
        if (tree.is_inside(center)) boxes.push_back(box);
      }
  return boxes;
}

// Counted before any is listed: a spacing that is far too small must not take all of the memory.
void check_budget(const std::vector<LatticeBox>& boxes, std::size_t max_roots) {
  std::size_t num_roots = 0;
  for (const LatticeBox& box : boxes) num_roots += box.num_cubes();
  if (num_roots == 0)
    throw Error(ErrorCode::BadGeometry,
                "no lattice cube lies inside the polycube; give a smaller spacing");
  if (num_roots > max_roots)
    throw Error(ErrorCode::OutOfResources,
                "the polycube has " + std::to_string(num_roots) + " lattice cubes, more than the " +
                    std::to_string(max_roots) +
                    " cells allowed; give a larger spacing or raise --max-cells");
}

void collect_roots(Lattice& lattice, const std::vector<LatticeBox>& boxes) {
  for (const LatticeBox& box : boxes)
    for (int z = box.low[2]; z < box.high[2]; ++z)
      for (int y = box.low[1]; y < box.high[1]; ++y)
        for (int x = box.low[0]; x < box.high[0]; ++x) lattice.roots.push_back({x, y, z});
  std::sort(lattice.roots.begin(), lattice.roots.end(),
            [](const LatticeCoord& a, const LatticeCoord& b) {
              return std::tie(a[2], a[1], a[0]) < std::tie(b[2], b[1], b[0]);
            });
}

}  // namespace

Lattice place_on_lattice(const Faces& faces, const AxisScales& scales, double spacing,
                         std::size_t max_roots) {
  if (!is_within_limit(scales))
    throw Error(ErrorCode::BadArgument,
                "the polycube is more than 1000 lattice cubes long; give a larger spacing");
  Lattice lattice = faces.lattice;
  lattice.spacing = spacing;
  lattice.max_deviation /= spacing;
  std::array<std::vector<int>, 3> planes;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (double x : faces.planes[axis])
      planes[axis].push_back(static_cast<int>(std::lround(scales[axis](x))));
  for (std::size_t c = 0; c < lattice.charts.size(); ++c) {
    Chart& chart = lattice.charts[c];
    chart.plane = planes[static_cast<std::size_t>(chart.axis)][faces.chart_plane[c]];
  }
  for (Vec3& p : lattice.tets.positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] = scales[static_cast<std::size_t>(axis)](p[axis]);
  // Exactly, whatever the scales' rounding.
  for (TriId t : lattice.facets.ids()) {
    const Chart& chart = lattice.charts[static_cast<std::size_t>(lattice.facet_to_chart[t])];
    for (VertId v : lattice.facets[t]) lattice.tets.positions[v][chart.axis] = chart.plane;
  }
  const auto boxes = boxes_inside(lattice, planes);
  check_budget(boxes, max_roots);
  collect_roots(lattice, boxes);
  return lattice;
}

}  // namespace hexwright::polycube
