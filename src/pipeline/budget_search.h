// The best mesh that a number of hexes allows.
#pragma once

#include "hexwright/pipeline/mesh_surface.h"

#include "pipeline/quiet_run.h"

namespace hexwright {

/// The result of `run` for the options when `most_hexes` did not limit it, or it is near enough
/// nevertheless. Else the nearest of those that coarser tolerances lead to, from the coarsest on
/// until one has too many hexes: whatever fits fits a larger number too, so that more hexes never
/// give a mesh that is farther off. Where the tolerance sizes nothing, levels are taken away
/// instead. Says what was used up. `run` throws OutOfResources for more than `most_hexes`. Errors:
/// OutOfResources when the coarsest has too many.
MeshResult search_budget(const MeshOptions& options, MeshRun run, const Context& context);

}  // namespace hexwright
