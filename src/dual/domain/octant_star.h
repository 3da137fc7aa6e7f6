// The cells of the domain around one lattice vertex, one face-connected part at a time.
#pragma once

#include <bit>
#include <vector>

#include "dual/domain/domain.h"

namespace hexwright::dual {

/// Octants around a lattice vertex that the domain covers and that are connected through faces.
/// Parts of the domain that touch at an edge or vertex only fall into different stars.
/// Octant q lies on the high side of axis a when bit a of q is set.
struct OctantStar {
  LatticeCoord vert = {0, 0, 0};  ///< on the lattice of the roots
  int mask = 0;                   ///< bit q: octant q belongs to the star

  bool has(int octant) const { return mask >> octant & 1; }
  int num_octants() const { return std::popcount(static_cast<unsigned>(mask)); }
  /// Octants around the half-edge that leaves the vertex along `axis` to its low (0) or high side.
  int around_edge(int axis, int side) const { return mask & kSideMask[axis][side]; }
  /// How many there are: 1 convex crease, 2 flat, 3 concave crease, 4 interior.
  int num_around_edge(int axis, int side) const {
    return std::popcount(static_cast<unsigned>(around_edge(axis, side)));
  }
  /// The octant itself has both of its neighbours across the faces that hold the half-edge.
  bool is_middle(int octant, int axis) const {
    return has(octant ^ 1 << (axis + 1) % 3) && has(octant ^ 1 << (axis + 2) % 3);
  }
};

/// All stars of the domain, by vertex (z, y, x) and then by lowest octant. Throws
/// Error{BadGeometry} on a star that touches itself along an edge.
std::vector<OctantStar> collect_octant_stars(const Domain& domain);

}  // namespace hexwright::dual
