// Each axis is mapped by its scale, which takes planes to integers. Two planes never fall together,
// however thin the part between them.
//
// Based on: Pitzalis et al. 2021, section 6.2.
// Differs: planes need not lie on a lattice; each axis is stretched between them.
#include "polycube/lattice.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "hexwright/base/error.h"
#include "hexwright/geometry/surface_tree.h"

#include "polycube/charts.h"

namespace hexwright::polycube {
namespace {

// The box between neighbouring planes of each axis is inside or outside as a whole, and its centre
// is far from every plane: the winding number is never asked near the boundary.
void collect_roots(Lattice& lattice, const std::array<std::vector<int>, 3>& planes) {
  TriMesh boundary;
  boundary.positions = lattice.tets.positions;
  boundary.tris = lattice.facets;
  const SurfaceTree tree(boundary);
  const auto middle = [&](std::size_t axis, std::size_t i) {
    return (planes[axis][i] + planes[axis][i + 1]) / 2.0;
  };
  for (std::size_t k = 0; k + 1 < planes[2].size(); ++k)
    for (std::size_t j = 0; j + 1 < planes[1].size(); ++j)
      for (std::size_t i = 0; i + 1 < planes[0].size(); ++i) {
        if (!tree.is_inside({middle(0, i), middle(1, j), middle(2, k)})) continue;
        for (int z = planes[2][k]; z < planes[2][k + 1]; ++z)
          for (int y = planes[1][j]; y < planes[1][j + 1]; ++y)
            for (int x = planes[0][i]; x < planes[0][i + 1]; ++x)
              lattice.roots.push_back({x, y, z});
      }
  if (lattice.roots.empty())
    throw Error(ErrorCode::BadGeometry,
                "no lattice cube lies inside the polycube; give a smaller spacing");
  std::sort(lattice.roots.begin(), lattice.roots.end(),
            [](const LatticeCoord& a, const LatticeCoord& b) {
              return std::tie(a[2], a[1], a[0]) < std::tie(b[2], b[1], b[0]);
            });
}

}  // namespace

Lattice place_on_lattice(const Faces& faces, const AxisScales& scales, double spacing) {
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
  for (Chart& chart : lattice.charts)
    chart.plane =
        planes[static_cast<std::size_t>(chart.axis)][static_cast<std::size_t>(chart.plane)];
  for (Vec3& p : lattice.tets.positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] = scales[static_cast<std::size_t>(axis)](p[axis]);
  // Exactly, whatever the scales' rounding.
  for (TriId t : lattice.facets.ids()) {
    const Chart& chart = lattice.charts[static_cast<std::size_t>(lattice.facet_to_chart[t])];
    for (VertId v : lattice.facets[t]) lattice.tets.positions[v][chart.axis] = chart.plane;
  }
  collect_roots(lattice, planes);
  return lattice;
}

Lattice fit_lattice(const TetMesh& polycube, double spacing) {
  const Faces faces = find_faces(polycube, spacing);
  if (spacing <= 0) spacing = geometric_spacing(faces.planes);
  return place_on_lattice(faces, even_scales(faces.planes, spacing), spacing);
}

}  // namespace hexwright::polycube
