// Ids of mesh elements. Surfaces and tet meshes have `tri`/`tet`, hex meshes `hex`/`quad`; all have
// `vert`.
#pragma once

#include "hexwright/base/ids.h"

namespace hexwright {

using VertId = Id<struct VertTag>;    ///< vertex of the mesh at hand
using TriId = Id<struct TriTag>;      ///< triangle of a surface
using TetId = Id<struct TetTag>;      ///< tetrahedron
using HexId = Id<struct HexTag>;      ///< hexahedron
using QuadId = Id<struct QuadTag>;    ///< boundary quad of a hex mesh
using PatchId = Id<struct PatchTag>;  ///< smooth part of a surface between feature curves
using CurveId = Id<struct CurveTag>;  ///< feature curve of a surface

}  // namespace hexwright
