// Meshing a CAD model: what it adds to the wishes before, and to the mesh after.
#pragma once

#include <vector>

#include "hexwright/cad/cad_surface.h"
#include "hexwright/cad/read_cad.h"
#include "hexwright/pipeline/mesh_surface.h"

namespace hexwright {

/// How finely a file is read for a mesh with these options: a tenth of the tolerance.
CadReadOptions read_options_for(const MeshOptions& options);

/// A model and the surface that it is meshed by.
struct CadInput {
  CadModel model;
  CadSurface surface;
  std::vector<std::size_t> num_matched;  ///< per rule: triangles named by it
};

/// Names the patches by the file and by rules (their files read), joins faces that meet smoothly.
CadInput prepare_cad(CadModel model, std::vector<PatchRule> rules, const MeshOptions& options);

/// The wishes with the model's features and its exact shape. Vertices that would be balanced about
/// the surface are on it instead.
MeshOptions options_for_cad(const MeshOptions& wishes, const CadInput& input);

/// mesh_surface() with these; then hexes have the region of their solid and curves the names of the
/// model's edges.
///
/// What is connected is one region: of solids that were united, called by all of them ("lid+base").
/// Solids without names are solid_1, solid_2 ...; one that is alone and has none leaves the mesh
/// without regions, as do meshes of the outside.
MeshResult mesh_cad(const CadInput& input, const MeshOptions& wishes, const Context& context);

}  // namespace hexwright
