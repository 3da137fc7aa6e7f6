// Hexes of second order, as readers find them.
#pragma once

#include "io/content/volume_file.h"

namespace hexwright::io {

/// Collects the nodes beyond the corners; ids are of the file's positions.
class MidNodeReader {
 public:
  /// Of the hex that was added last. In VTK's order: corners, which are passed over, edges and, of
  /// 27 nodes, faces and middle.
  void add(const VolumeFile& file, std::span<const VertId> nodes);

  /// Sets the file's mid-nodes; those that nothing else uses are vertices no longer. Hexes of first
  /// order have their nodes on the chords. Nothing happens when there were none. Throws
  /// Error{BadFile} where hexes do not agree on the node of an edge.
  void settle(VolumeFile& file, const std::string& name);

 private:
  IdVector<HexId, std::array<VertId, 19>> hex_to_nodes_;  // invalid where there is none
};

}  // namespace hexwright::io
