// From the names of a surface's groups to names of the mesh's patches and curves.
#pragma once

#include <string>

#include "hexwright/geometry/feature_graph.h"
#include "hexwright/geometry/patch_index.h"
#include "hexwright/mesh/hex_mesh.h"

namespace hexwright::fitting {

/// Names the patches and curves of a finished mesh by the groups of the surface; without effect on
/// a surface without several groups. Where a border between groups is on no mesh edges, as when its
/// curve could not be followed, the patch is divided along quads, by the nearest triangle to each;
/// the larger part keeps the patch's number, others get new ones. Patches of one group are numbered
/// "wall.1", "wall.2"; one patch alone is "wall".
void name_labels(const SurfaceTree& tree, const PatchIndex& patches, const FeatureGraph& features,
                 HexMesh& mesh);

/// Gives every patch this name, numbered where there are several.
void name_all_patches(const std::string& name, BoundaryLabels& labels);

}  // namespace hexwright::fitting
