// Where the mid-nodes of edges belong.
#pragma once

#include <vector>

#include "hexwright/curving/curve_mesh.h"

namespace hexwright::curving {

/// What a mesh edge stands for.
enum class EdgeKind : std::uint8_t {
  Inner,     ///< nothing: straight
  Surface,   ///< a piece of a patch
  Curve,     ///< a piece of a feature curve
  Unmatched  ///< one of these, but the surface is not near
};

struct EdgeTargets {
  IdVector<EdgeId, EdgeKind> kind;
  IdVector<EdgeId, Vec3> offset;  ///< of the target from the middle of the chord
};

/// Requires straight mid-nodes. An edge belongs to the curve of its label, else to the patch of the
/// labelled quads that have it as a side.
EdgeTargets find_edge_targets(const HexMesh& mesh, const CurvingTarget& target);

}  // namespace hexwright::curving
