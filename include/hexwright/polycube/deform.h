// Deforms a tetrahedral mesh to the polycube that labels on its boundary describe.
#pragma once

#include <array>
#include <cstdint>

#include "hexwright/base/context.h"
#include "hexwright/base/function_ref.h"
#include "hexwright/mesh/tet_mesh.h"
#include "hexwright/polycube/surface_labels.h"

namespace hexwright {

struct Deformation {
  TetMesh polycube;         ///< the object's tets, in its units; all positive
  LabelCharts charts;       ///< of the boundary; its corners are vertices of the tets
  TriMesh surface;          ///< the object's boundary, over the tets' vertices
  double least_det = 0;     ///< volume of a tet over its volume in the object, the least ...
  double greatest_det = 0;  ///< ... and the greatest, of those of the whole
};

/// `label_of` gives the label of a facet of the boundary, seen from outside. The planes of the
/// faces are where the map is best, and on no common lattice. Requires connected, positive tets.
/// Errors: those of find_label_charts(); BadGeometry, with the place, when tets stay folded.
Deformation deform_to_polycube(
    const TetMesh& object, FunctionRef<std::uint8_t(const std::array<VertId, 3>& facet)> label_of,
    const Context& context);

}  // namespace hexwright
