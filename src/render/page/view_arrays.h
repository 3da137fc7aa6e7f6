// The arrays of a page, packed: what viewer/src/data.js unpacks.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/page/view_scene.h"

namespace hexwright {

/// Name and packed text of each array. All numbers are little-endian byte planes; "deltas" are
/// differences by to_deltas. n hexes, m vertices, f marked faces are those of the sample.
///   positions   3 axes one behind the other, each m deltas of 2 bytes: shares of the box, 65535 =
///               its upper end
///   hexes       8 n numbers of 4 bytes: vertex 0 minus the last hex's, others minus the one before
///   quality     n bytes: 0 = inverted (scaled Jacobian <= 0), k = up to k / 250
///   depth       n bytes: layers from the boundary
///   faces       n bytes: bits of marked faces, by local face
///   patches     f numbers of 4 bytes: patch + 1, 0 = none; left out without labels
///   regions     n numbers of 4 bytes: index into the scene's list; left out for one region
///   hex_ids     n deltas of 4 bytes; where not all hexes are there
///   vert_ids    m deltas of 4 bytes; where not all vertices are there
///   distance    f bytes: shares of the largest, 255 = it; with a surface only
///   field_I     n bytes: shares of field I's range
///   mid_positions  as positions, of the nodes of curved edges; of second order only
///   hex_mids    12 n deltas of 4 bytes: per edge of a hex the node + 1, 0 = straight
///   curves      deltas of 4 bytes: 2 per edge; curve_ids: deltas of 4 bytes, curve + 1
///   corners     deltas of 4 bytes
///   surface_positions, surface_tris   as positions; 3 deltas of 4 bytes per triangle
using ViewArrays = std::vector<std::pair<std::string, std::string>>;

/// `regions` are the tags, ascending.
ViewArrays make_view_arrays(const HexMesh& mesh, const ViewScene& scene, const ViewOptions& options,
                            const std::vector<std::int32_t>& regions);

/// The code of a scaled Jacobian in the array `quality`.
std::uint8_t quality_code(double scaled_jacobian);

/// Low and high of a field's finite values; 0 and 0 without any.
std::pair<double, double> field_range(const HexField& field);

/// The largest of the faces' finite distances.
double largest_distance(const ViewScene& scene);

/// Box of the mesh and the surface: what positions are shares of.
Box3 view_box(const HexMesh& mesh, const ViewOptions& options);

/// Vertices of the sample's hexes, ascending.
std::vector<VertId> sampled_verts(const HexMesh& mesh, const ViewSample& sample);

}  // namespace hexwright
