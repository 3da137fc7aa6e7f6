// Runs the stages until the sizes of the mesh are those that were asked for.
#pragma once

#include "hexwright/pipeline/mesh_surface.h"

#include "pipeline/quiet_run.h"

namespace hexwright {

/// The result of `run` for the options or, with a size, for a smaller one, so that 95% of the edges
/// are no longer than 1.05 times what was asked for: where the boundary is oblique or curved, edges
/// are longer than the lattice's. With a number of cells, for the size that gives about as many.
/// Results of `run` are in world coordinates. Warns when the goal is out of reach.
MeshResult search_sizes(const Target& target, const MeshOptions& options, MeshRun run,
                        const Context& context);

}  // namespace hexwright
