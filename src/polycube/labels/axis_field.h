// A coordinate of a polycube as a function over the object: the start of a deformation.
#pragma once

#include <span>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/mesh/tet_mesh.h"

namespace hexwright::polycube {

/// The vertices of a face across the axis, and which way it looks.
struct AxisFace {
  int sign = 1;
  std::vector<VertId> verts;  ///< ascending
  double area = 0;
};

/// One value per vertex: equal within each face, growing towards faces that look up the axis, with
/// a gradient of length one as nearly as that can be. However the object is bent: no direction in
/// space is used. Requires a connected mesh of positive tets, and that no two faces share a vertex.
/// Values are unique but for a constant, which is left open. The same for any number of threads.
std::vector<double> compute_axis_field(const TetMesh& object, std::span<const AxisFace> faces,
                                       const Context& context);

}  // namespace hexwright::polycube
