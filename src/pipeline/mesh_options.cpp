// Options that stand for several others.
#include "hexwright/pipeline/mesh_surface.h"

namespace hexwright {

/// What the loop would find out by measuring has to be assumed: the criterion's full strictness.
void use_single_pass(MeshOptions& options) {
  options.max_rounds = 0;
  options.sizing.deviation_factor = 1;
  options.sizing.crease_proximity = 0.75;
}

/// Short loose creases are noise of scanned and decimated surfaces; sizing by them would refine
/// whole models to the deepest level.
FeatureOptions features_for_sizing(const FeatureOptions& options, double diagonal) {
  constexpr double kPruning = 0.03;
  FeatureOptions result = options;
  result.min_length = kPruning * diagonal;
  return result;
}

}  // namespace hexwright
