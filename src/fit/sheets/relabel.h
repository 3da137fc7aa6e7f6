// What a sheet does to the attributes of vertices and to the marks on the boundary.
#pragma once

#include "fit/curves/boundary_state.h"
#include "fit/sheets/insert.h"

namespace hexwright::fitting {

/// Inserts the plan's sheet and rewrites state and boundary after it; both are rebuilt. When the
/// insertion fails nothing has changed.
/// - Quads that follow take the copies. The sheet's own boundary quads, over the rim, join their
///   regions.
/// - A marked edge stays with the originals where it bounds a quad that does not follow, otherwise
///   it takes the copies. Curves gain the edges from the rim's vertices to copies on curves.
/// - A vertex all of whose boundary quads follow hands its place to its copy and is inside then.
Insertion apply_plan(FitState& state, BoundaryState& boundary, const SheetPlan& plan);

}  // namespace hexwright::fitting
