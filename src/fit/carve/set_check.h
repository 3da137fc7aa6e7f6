// Whether a set of hexes has a proper boundary at a vertex: manifold, and visible from some
// direction, so that a layer of hexes can be inserted along it.
#pragma once

#include <vector>

#include "hexwright/mesh/hex_adjacency.h"

#include "fit/carve/visible_normal.h"

namespace hexwright::fitting {

enum class SetFault : char {
  None,
  NonManifold,        ///< the set's hexes around the vertex, or the others, are not face-connected
  NoVisibleDirection  ///< no direction sees all boundary quads at the vertex well enough
};

/// The mesh and its adjacency must outlive the check. Not thread-safe: one object per thread.
class SetCheck {
 public:
  /// `beyond_is_out`: the space beyond the mesh's boundary counts as one more hex outside the set;
  /// otherwise the mesh's boundary is no boundary of the set.
  SetCheck(const HexMesh& mesh, const VertToHex& vert_to_hex, const HexNeighbors& neighbors,
           bool beyond_is_out)
      : mesh_(mesh),
        vert_to_hex_(vert_to_hex),
        neighbors_(neighbors),
        beyond_is_out_(beyond_is_out) {}

  /// Requires normals n of the set's boundary quads at v with n . d >= least_cosine for some d.
  SetFault check(VertId v, const std::vector<char>& in_set, double least_cosine);

  /// Whether the set's hexes around v, and the others, are each connected by faces at v.
  bool is_manifold(VertId v, const std::vector<char>& in_set) { return is_connected(v, in_set); }

  /// The best direction out of the set at v (zero when the set has no boundary there).
  VisibleDirection direction(VertId v, const std::vector<char>& in_set);

 private:
  bool is_in(HexId h, const std::vector<char>& in_set) const { return in_set[h.index()] != 0; }
  void collect_normals(VertId v, const std::vector<char>& in_set);
  bool is_connected(VertId v, const std::vector<char>& in_set);
  int find(int x);

  const HexMesh& mesh_;
  const VertToHex& vert_to_hex_;
  const HexNeighbors& neighbors_;
  bool beyond_is_out_;
  std::vector<Vec3> normals_;  // of the set's boundary quad corners at the vertex
  std::vector<int> parent_;    // union-find over the hexes at the vertex, the space beyond last
};

}  // namespace hexwright::fitting
