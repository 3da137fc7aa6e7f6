// The boundary of a hex mesh, complete, for formats in which every outer face must have a patch.
#pragma once

#include "hexwright/io/set_table.h"

namespace hexwright::io {

/// A face of the boundary and the patch that it is on.
struct BoundarySide {
  HexFace face;
  std::size_t patch;  ///< index into SetTable::patches, or their number for a face without a label
};

/// A labelled quad between two hexes, as on the interface of two regions.
struct InnerSide {
  HexFace face;  ///< of the lower hex
  std::size_t quad, patch;
};

struct BoundarySides {
  HexNeighbors neighbors;
  std::vector<BoundarySide> outer;  ///< every boundary face once, by patch, then by hex
  std::vector<InnerSide> inner;     ///< by quad
  bool has_unlabeled = false;

  /// What faces without a label are called: the name is not among those of the table.
  std::string unlabeled_name;
};

/// The first label of a face counts. Throws Error{BadArgument} for a mesh with faces of three
/// hexes, and for a labelled quad that is no face.
BoundarySides find_boundary_sides(const HexMesh& mesh, const SetTable& table);

}  // namespace hexwright::io
