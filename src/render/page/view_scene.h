// What a page holds about a mesh: its measures and names, found before anything is packed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hexwright/mesh/hex_adjacency.h"
#include "hexwright/render/view_page.h"

#include "render/page/view_sample.h"

namespace hexwright {

/// Faces of a hex that bound the mesh or carry a patch, as bits.
using FaceMask = std::uint8_t;

struct ViewScene {
  HexNeighbors adjacency;
  IdVector<HexId, double> scaled_jacobian;
  IdVector<HexId, std::uint8_t> depth;  ///< steps by faces from the boundary; 255 = so many or more
  IdVector<HexId, FaceMask> marked;
  /// Of each face that is marked, in order of (hex, lf).
  std::vector<PatchId> patch;
  std::vector<float> distance;  ///< to the surface, world units; empty without one
  ViewSample sample;
};

ViewScene make_view_scene(const HexMesh& mesh, const ViewOptions& options);

}  // namespace hexwright
