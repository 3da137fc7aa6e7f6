// Where walls are thin beside how far the mesh is off: finer cells there bring the volume back.
#pragma once

#include <vector>

#include "pipeline/loop/round.h"

namespace hexwright {

/// Points on the surface whose distance from the mesh is more than a small share of the solid's
/// thickness there. None where the volume is near enough, or not known.
std::vector<Vec3> find_thin_misses(const RoundInput& input, const Round& round);

}  // namespace hexwright
