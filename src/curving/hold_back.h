// Keeps the elements of a curved mesh valid.
#pragma once

#include "hexwright/mesh/hex_mesh.h"

namespace hexwright::curving {

/// Shares of the offsets, 1 where nothing is held back, with which every element that is valid with
/// straight edges is proven valid. Sets the mesh's mid-nodes accordingly. `offset`: of each
/// mid-node from the middle of its chord.
IdVector<EdgeId, double> hold_back(const IdVector<EdgeId, Vec3>& offset, HexMesh& mesh);

}  // namespace hexwright::curving
