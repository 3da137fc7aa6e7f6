// What the boundary of a solid's mesh should be made of, as far as the surface tells.
#pragma once

#include <cstddef>

#include "hexwright/geometry/surface_tree.h"

namespace hexwright {

/// Known only for closed manifold surfaces whose components each bound the solid or lie wholly
/// inside it; overlapping parts merge in ways that counting cannot foretell.
struct ExpectedTopology {
  bool is_known = false;
  std::size_t num_components = 0;  ///< of the boundary
  long euler_characteristic = 0;   ///< of the boundary
  long genus() const { return static_cast<long>(num_components) - euler_characteristic / 2; }
};

/// Tells by winding numbers on both sides of a few triangles which components bound the solid.
ExpectedTopology find_expected_topology(const SurfaceTree& tree);

}  // namespace hexwright
