// Counts that tell the topology of a set of hexes, and whether flipping one hex changes it.
#pragma once

#include <vector>

#include "hexwright/mesh/hex_adjacency.h"

namespace hexwright::fitting {

/// Of the set's boundary, which must be manifold for the counts to mean anything.
struct SetTopology {
  std::size_t num_components = 0;
  long euler_characteristic = 0;
};
SetTopology compute_set_topology(const HexMesh& mesh, const HexNeighbors& neighbors,
                                 const std::vector<char>& in_set);

/// Bit lf is set when the neighbour across face lf is in the set.
unsigned faces_on_set(const HexNeighbors& neighbors, const std::vector<char>& in_set, HexId h);

/// Whether these faces of a hex form a disc. Where the set's boundary is manifold at all vertices
/// of the hex both with and without the hex, the hex meets the rest of the set in just these faces;
/// adding or removing it then keeps the set's topology exactly if they are a disc.
bool is_disc(unsigned faces);

/// Whether some axis of the hex has neither of its two faces in `faces`. With the faces on hexes of
/// its own kind: whether the hex is all there is of a wall or gap along that axis.
bool is_one_thick(unsigned faces);

}  // namespace hexwright::fitting
