#include "hexwright/grid/occupancy.h"

#include "hexwright/geometry/surface_topology.h"
#include "hexwright/geometry/surface_tree.h"

namespace hexwright {

Occupancy occupancy_of(const SurfaceTree& tree) {
  Occupancy object;
  object.meets_surface = [&tree](const Box3& box) {
    ClosestFilter filter;
    filter.max_distance = 0.5 * box.diagonal();
    return tree.closest(box.center(), filter).has_value();
  };
  object.is_inside = [&tree](const Vec3& p) { return tree.is_inside(p); };
  object.has_two_sides = is_oriented_cycle(tree.surface());
  return object;
}

}  // namespace hexwright
