// Changes as few hexes of a set as it can so that its boundary is manifold and visible everywhere.
#pragma once

#include "fit/carve/carve_classify.h"
#include "fit/carve/set_check.h"

namespace hexwright::fitting {

struct RepairResult {
  std::size_t num_flips = 0;      ///< hexes whose membership changed, counting repeats
  std::size_t num_bad_verts = 0;  ///< vertices that could not be mended: their hexes were cut away
};

/// Deterministic. `in_set` is changed in place; `visible` is the least cosine of SetCheck::check.
RepairResult repair_set(const HexMesh& mesh, const VertToHex& vert_to_hex,
                        const HexNeighbors& neighbors, const HexFilling& filling, double visible,
                        std::vector<char>& in_set);

}  // namespace hexwright::fitting
