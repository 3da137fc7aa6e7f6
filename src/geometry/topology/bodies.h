// The bodies of an assembly: solids, each with the cavities in it.
#pragma once

#include <vector>

#include "geometry/topology/closed_pieces.h"

namespace hexwright {

/// By their first triangles. Cavities in no solid, and triangles of no closed piece, belong to
/// none. Empty when there are not several solids.
std::vector<ClosedPiece> find_bodies(const TriMesh& surface);

}  // namespace hexwright
