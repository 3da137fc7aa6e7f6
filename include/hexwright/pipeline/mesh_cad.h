// Meshing a CAD model: what it adds to the wishes before, and to the mesh after.
#pragma once

#include "hexwright/cad/cad_surface.h"
#include "hexwright/cad/read_cad.h"
#include "hexwright/pipeline/mesh_surface.h"

namespace hexwright {

/// How finely a file is read for a mesh with these options: a tenth of the tolerance.
CadReadOptions read_options_for(const MeshOptions& options);

/// The wishes with the model's features and its exact shape.
MeshOptions options_for_cad(const MeshOptions& wishes, const CadModel& model,
                            const CadSurface& surface);

/// Gives hexes the region of their solid. What is connected is one region: of solids that were
/// united, called by all of them ("lid+base"). Solids without names are solid_1, solid_2 ...; one
/// that is alone and has none leaves the mesh as it is. For meshes of the inside.
void name_solids(const CadModel& model, HexMesh& mesh);

}  // namespace hexwright
