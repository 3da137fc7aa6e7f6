// How long the edges of a hex mesh are.
#pragma once

#include "hexwright/geometry/similarity.h"
#include "hexwright/mesh/hex_mesh.h"

namespace hexwright {

/// Lengths of the distinct edges; zeros for a mesh without hexes.
struct EdgeLengths {
  std::size_t num_edges = 0;
  double min = 0, median = 0, max = 0;
  double high = 0;  ///< 95% of the edges are no longer

  void to_world(const Similarity& frame) {
    for (double* length : {&min, &median, &high, &max}) *length = frame.length_to_world(*length);
  }
};

EdgeLengths measure_edges(const HexMesh& mesh);

}  // namespace hexwright
