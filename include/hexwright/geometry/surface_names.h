// Names of a surface's patches, curves and body, from the names of its groups.
#pragma once

#include <string>
#include <vector>

#include "hexwright/geometry/feature_graph.h"

namespace hexwright {

/// Whether the surface has several groups, which then name its patches.
bool has_named_patches(const TriMesh& surface);

/// The name of the body when all triangles have the same group, else "".
std::string name_of_body(const TriMesh& surface);

/// Names of curves by the groups on their sides: "inlet-wall", numbered ("inlet-wall.1") where
/// several curves part the same two; "" for a curve inside one group. Empty when the surface has no
/// named patches.
IdVector<CurveId, std::string> name_curves(const TriMesh& surface, const FeatureGraph& features);

/// Numbers names that come more than once: "wall", "wall", "" becomes "wall.1", "wall.2", "".
/// Numbers that make a name that is there already are passed over.
void number_repeated(std::vector<std::string>& names);

}  // namespace hexwright
