// A tetrahedral mesh.
#pragma once

#include <array>
#include <optional>

#include "hexwright/base/issue.h"
#include "hexwright/base/vec3.h"
#include "hexwright/mesh/element_ids.h"

namespace hexwright {

struct TetMesh {
  IdVector<VertId, Vec3> positions;
  IdVector<TetId, std::array<VertId, 4>> tets;  ///< positive volume: det(p1-p0, p2-p0, p3-p0) > 0

  std::size_t num_verts() const { return positions.size(); }
  std::size_t num_tets() const { return tets.size(); }

  /// First index out of range or coordinate that is not finite.
  std::optional<Issue> find_problem() const;
};

}  // namespace hexwright
