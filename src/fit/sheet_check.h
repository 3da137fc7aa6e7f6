// Is the surface of a set of hexes a proper, visible surface around a vertex?
#pragma once

#include <span>

#include "hexwright/mesh/hex_adjacency.h"

#include "fit/visible_direction.h"

namespace hexwright::fitting {

enum class VertVerdict {
  Good,         ///< off the set's surface, or on it with nothing wrong
  NotManifold,  ///< the hexes of the set around it, or the others, are not connected by faces
  NotVisible    ///< no direction sees all faces of the set's surface around it
};

struct VertCheck {
  VertVerdict verdict = VertVerdict::Good;
  bool is_on_surface = false;
  SheetDirection visible;  ///< away from the set; of a vertex on the surface
};

/// The surface of a set are its faces towards other hexes and, with `counts_outside`, also those on
/// the mesh's boundary; everything beyond the boundary then counts as one hex outside the set.
struct SheetCheck {
  const HexMesh& mesh;
  const VertToHex& vert_to_hex;
  const HexNeighbors& neighbors;
  double min_cosine = 0.1;
  bool counts_outside = false;

  /// `is_in_set`: one entry per hex.
  VertCheck check(VertId v, std::span<const char> is_in_set) const;
};

}  // namespace hexwright::fitting
