// Inserts a layer of hexes around a set of hexes (a pillow).
//
// Based on: Mitchell, Tautges, "Pillowing doublets", 4th International Meshing Roundtable, 1995.
// Differs: the copies start on directions that see all faces around them, so that a thin enough
// layer always has positive corner determinants.
#pragma once

#include <vector>

#include "fit/fit_state.h"

namespace hexwright::fitting {

struct LayerOptions {
  bool on_outer_boundary = true;  ///< the layer also runs along the mesh's boundary, not only
                                  ///< between the set and the other hexes
  double thickness = 0.3;         ///< at first, share of the shortest edge at each vertex
  double least_jacobian = 1e-7;   ///< the layer is thinned until every corner's scaled Jacobian
                                  ///< exceeds this
};

struct LayerResult {
  /// Per vertex of the mesh before: its copy on the set's side; invalid off the layer. The original
  /// stays where it was (and keeps its kind); the copy is an Interior vertex.
  IdVector<VertId, VertId> copy;
  HexId first_new_hex;  ///< the new hexes are this one and all after it, one per face
  std::size_t num_new_hexes = 0;
  bool is_valid = true;  ///< false: some corner could not be made positive; the mesh is unusable
};

/// `directions`: per vertex a unit vector out of the set that sees the layer's faces (SetCheck).
/// Reads the state's adjacency, changes its mesh; call state.rebuild() before anything else.
/// Faces whose vertices may all move in fixed sets only (the domain's box) get no layer.
LayerResult insert_layer(FitState& state, const std::vector<char>& in_set,
                         const IdVector<VertId, Vec3>& directions, const LayerOptions& options);

/// One layer under the whole boundary. Throws Error{BadGeometry} when a vertex of the boundary
/// cannot be seen from outside (carve makes none). Rebuilds the state.
void pad_boundary(FitState& state);

}  // namespace hexwright::fitting
