// What a surface is, before anyone meshes it, and what meshing would make of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/cad/cad_surface.h"
#include "hexwright/pipeline/mesh_surface.h"

namespace hexwright {

/// A place on the surface, in its coordinates, and a length that belongs to it.
struct InspectedPlace {
  Vec3 position;
  double length = 0;
};

/// A name of the file, and how many triangles carry it.
struct NamedShare {
  std::string name;
  std::size_t num_tris = 0;
};

struct SurfaceInspection {
  std::size_t num_verts = 0, num_tris = 0;  ///< as read
  Box3 box;
  double area = 0;                ///< with the patches that close its holes
  double volume = 0;              ///< of the object that would be meshed
  std::size_t num_solids = 0;     ///< closed pieces, consistently oriented
  std::size_t num_cavities = 0;   ///< closed pieces that point inwards
  std::size_t num_open_tris = 0;  ///< triangles of no closed piece
  std::size_t num_open_edges = 0, num_nonmanifold_edges = 0;
  /// Pairs of triangles that pass through each other, and the places of the first of them (at
  /// most kMaxPlaces, spread over the pairs).
  std::size_t num_crossings = 0;
  std::vector<InspectedPlace> crossings;  ///< length: 0
  /// Walls thinner than the tolerance that was asked about, thinnest first, at most kMaxPlaces.
  std::size_t num_thin_samples = 0, num_wall_samples = 0;
  double least_thickness = 0;        ///< of all samples of the walls; 0 = no walls face each other
  std::vector<InspectedPlace> thin;  ///< length: the thickness
  double sharp_length = 0;           ///< of the feature curves that sizing would see
  std::size_t num_sharp_curves = 0, num_corners = 0;
  std::vector<NamedShare> names;
  std::optional<CadSummary> cad;  ///< of a CAD file; filled by the caller
  std::string units_guess;        ///< a sentence; empty when the size tells nothing
  /// What `mesh` would say of its preparation: what is as it should be, and what may not be meant.
  std::vector<std::string> notes, warnings;
  /// Why `mesh` would refuse; empty when it would not. The figures of the object are 0 then.
  std::string refusal;

  static constexpr std::size_t kMaxPlaces = 10;
};

/// Looks at a surface as mesh_surface() with these options would. Never throws for what is wrong
/// with the surface. Linear but for searching; seconds for a million triangles.
SurfaceInspection inspect_surface(const TriMesh& surface, const MeshOptions& options,
                                  const Context& context);

/// For people, a few lines; and as one JSON object (keys: docs/cli.md).
std::string inspection_to_text(const SurfaceInspection& inspection);
std::string inspection_to_json(const SurfaceInspection& inspection);

}  // namespace hexwright
