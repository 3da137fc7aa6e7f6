// The labels of a hex mesh grouped by number, for formats with named sets.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hexwright/mesh/hex_adjacency.h"
#include "hexwright/mesh/hex_mesh.h"

namespace hexwright::io {

/// Indices of elements by label, in increasing order; -1 = without a label.
using ElementSets = std::map<std::int32_t, std::vector<std::size_t>>;

struct LabelSets {
  ElementSets hexes_of_region;
  ElementSets quads_of_patch;  ///< indices into labels.quads
  ElementSets edges_of_curve;  ///< indices into labels.edges
};
LabelSets group_labels(const HexMesh& mesh);

/// "PATCH_3", "PATCH_NONE" for -1; regions may be negative: "REGION_MINUS_2".
std::string set_name(std::string_view kind, std::int32_t label);

/// The hex and local face of every labelled quad: the first in (hex, lf) order for an inner one.
/// Throws Error{BadArgument} for a quad that is no face of any hex.
std::vector<HexFace> find_quad_faces(const HexMesh& mesh);

}  // namespace hexwright::io
