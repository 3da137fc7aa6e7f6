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
  std::size_t num_solids = 0;      ///< those of them that point outwards: the rest are cavities
  std::size_t num_hidden = 0;      ///< components of the surface that lie inside the solid
  long euler_characteristic = 0;   ///< of the boundary
  /// Every triangle separates inside from outside.
  bool is_all_boundary() const { return is_known && num_hidden == 0; }
  long genus() const { return static_cast<long>(num_components) - euler_characteristic / 2; }
};

/// Tells by winding numbers on both sides of a few triangles which components bound the solid.
ExpectedTopology find_expected_topology(const SurfaceTree& tree);

}  // namespace hexwright
