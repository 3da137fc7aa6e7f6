#include "hexwright/pipeline/mesh_surface.h"

namespace hexwright {

/// What the loop would find out by measuring has to be assumed: the criterion's full strictness.
void use_single_pass(MeshOptions& options) {
  options.max_rounds = 0;
  options.sizing.deviation_factor = 1;
  options.sizing.crease_proximity = 0.75;
}

}  // namespace hexwright
