// Which tet of many a point lies in.
#pragma once

#include <array>
#include <optional>

#include "hexwright/mesh/tet_mesh.h"

#include "base/box_tree.h"

namespace hexwright::io {

/// A tet and the weights of its vertices at a point in it.
struct TetLocation {
  TetId tet;
  std::array<double, 4> weights;  ///< at least 0 but for rounding; their sum is 1
};

/// Tets of either orientation; those without volume hold no point.
class TetTree {
 public:
  explicit TetTree(TetMesh mesh);

  /// The tet that holds the point, of several the one of the least number.
  std::optional<TetLocation> locate(const Vec3& p) const;

  const TetMesh& mesh() const { return mesh_; }

 private:
  TetMesh mesh_;
  BoxTree tree_;
};

}  // namespace hexwright::io
