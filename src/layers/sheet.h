// The sheet under the walls while it is one layer of hexes: its vertices, how high each is to
// stand over the wall, and in which direction.
#pragma once

#include <vector>

#include "layers/walls.h"

namespace hexwright::layers {

/// A vertex of a wall and its copy on the other side of the sheet.
struct SheetVert {
  VertId wall, inner;
  int spec = 0;                         ///< the first of those around
  double size = 0;                      ///< mean length of the wall's edges here
  double wish = 0;                      ///< height of all layers, as asked for
  double height = 0;                    ///< ... and as it is to be; at most the wish
  LayerLimit limit = LayerLimit::None;  ///< why it is less

  /// Unit normals of the wall's faces here, into the mesh, nearly equal ones as one.
  std::vector<Vec3> normals;
  Vec3 offset;             ///< from wall to inner where the height is 1
  bool is_convex = false;  ///< the sheet turns round a ridge or a tip here
  bool is_rim = false;     ///< the sheet ends here, in another patch
};

struct SheetHex {
  HexId hex;  ///< its local vertices 0-3 are inner, 4-7 on the wall
  int spec = 0;
  int label = Skin::kNoLabel;  ///< of its wall quad
};

struct SheetMesh {
  /// With the sheet. Labels follow; a rim's quads are {wall, wall, inner, inner}, a piece of a
  /// curve along it {wall, inner}.
  HexMesh mesh;
  std::vector<SheetVert> verts;
  std::vector<SheetHex> hexes;
  std::vector<LeftOut> left_out;
  IdVector<PatchId, double> wall_area;  ///< of walls, with a sheet or without, on each side
};

/// Inserts thin sheets under all walls of all regions, but for those that hold a vertex of
/// `blocked`.
SheetMesh insert_sheets(const HexMesh& mesh, const Similarity& frame, const WallPatches& patches,
                        const LayersOptions& options, const std::vector<VertId>& blocked = {});

}  // namespace hexwright::layers
