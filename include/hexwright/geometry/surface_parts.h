// What the labels of a mesh's boundary refer to.
#pragma once

#include "hexwright/geometry/feature_graph.h"
#include "hexwright/geometry/patch_index.h"

namespace hexwright {

/// Curves and patches of a surface under the numbers that a mesh's labels have. Patches that were
/// divided along quads have further numbers, which no triangle has.
struct SurfaceParts {
  FeatureGraph features;
  PatchIndex patches;  ///< of the tree of the target
};

}  // namespace hexwright
