// Which edges of a surface run along straight segments that a user gives as creases.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

struct EdgesAlong {
  std::vector<std::array<VertId, 2>> edges;  ///< of the surface; may repeat
  std::size_t num_unmatched = 0;             ///< segments that no edges of the surface run along
};

/// A segment's ends must be vertices of the surface, within 1e-5 of its diagonal, and one edge or a
/// straight chain of edges join them. Positions and not numbers identify vertices, because cleaning
/// a surface renumbers them. Where vertices coincide, the one with the chain is taken.
EdgesAlong find_edges_along(const TriMesh& surface, std::span<const std::array<Vec3, 2>> segments);

}  // namespace hexwright
