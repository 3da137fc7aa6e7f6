// Which hexes of a mesh a page holds.
#pragma once

#include <array>
#include <vector>

#include "hexwright/mesh/hex_adjacency.h"

namespace hexwright {

/// All hexes, or of a mesh that is too large for a page those by which it can be looked into.
struct ViewSample {
  std::vector<HexId> hexes;  ///< ascending
  bool is_whole = true;
  std::size_t num_skin = 0, num_worst = 0;  ///< of a part: hexes with a boundary face; worst hexes
  /// Of a part: where the slices lie, shares of the box along each axis. A cut there shows what it
  /// shows of the whole mesh.
  std::vector<double> slices;
};

/// Above `max_whole` hexes: the skin, both sides of the faces that a cut at each slice lays open,
/// and the 10,000 hexes of least value.
ViewSample choose_view_sample(const HexMesh& mesh, const HexNeighbors& adjacency,
                              const IdVector<HexId, double>& values, std::size_t max_whole);

}  // namespace hexwright
