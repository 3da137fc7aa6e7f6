// How each axis of the polycube is laid on the integer lattice: monotone, every plane of the
// polycube on an integer, stretched between the planes as the map asks for.
#pragma once

#include <array>
#include <vector>

#include "hexwright/mesh/tet_mesh.h"
#include "hexwright/polycube/polycube.h"

namespace hexwright::polycube {

/// Coordinates of the polycube's faces across each axis, ascending, in the input's units; two at
/// least.
using AxisPlanes = std::array<std::vector<double>, 3>;

/// Monotone map of one axis, linear between its knots and beyond them.
struct AxisScale {
  std::vector<double> from;  ///< input units, ascending; the planes are among them
  std::vector<double> to;    ///< lattice units, ascending; planes go to integers

  double operator()(double x) const;
  /// Lattice units per input unit.
  double slope(double x) const;

 private:
  std::size_t piece(double x) const;
};
using AxisScales = std::array<AxisScale, 3>;

/// The least distance of two planes, but at least 1/16 of the extent: what is finer is a matter of
/// resolution and left to the levels.
double geometric_spacing(const AxisPlanes& planes);

/// Planes that differ by w are round(w / spacing) cubes apart, but at least one: nothing between
/// two of them collapses.
AxisScales even_scales(const AxisPlanes& planes, double spacing);

/// Whether a grid can have that many roots along each axis.
bool is_within_limit(const AxisScales& scales);

/// A lattice that suits a map, and what it is expected to cost.
struct ScaleCandidate {
  AxisScales scales;
  double spacing = 0;  ///< mean edge of a root cube, input units
  int depth = 0;       ///< levels that its roots are finer than cubes of geometric_spacing()
  double cost = 0;     ///< expected cells, those at changes of level counted more than once
};

/// Lattices for a map, the one to try first in front: between even and fully stretched ones (denser
/// where the object is long along an axis), of several spacings, the one with the fewest cells that
/// meet `options.max_stretch` and the size field; among nearly equal ones that with the fewest
/// roots. The last is even.
std::vector<ScaleCandidate> suit_scales(const AxisPlanes& planes, const TetMesh& object,
                                        const TetMesh& polycube, const PolycubeOptions& options);

}  // namespace hexwright::polycube
