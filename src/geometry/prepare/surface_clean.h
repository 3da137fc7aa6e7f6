// The passes of prepare_surface that change which triangles there are.
#pragma once

#include <vector>

#include "hexwright/geometry/prepare_surface.h"
#include "hexwright/mesh/tri_mesh.h"

#include "geometry/topology/surface_edges.h"

namespace hexwright {

/// The surface under preparation, in the unit frame. Vertices keep their numbers until the end.
struct WorkingSurface {
  TriMesh mesh;
  IdVector<TriId, TriId> source;  ///< per triangle: its id in the input; invalid: made here
  /// Per vertex beyond those of the input: the one that it is a copy of; invalid: made here.
  std::vector<VertId> added_from;

  /// Keeps the triangles for which the flag is set.
  void keep(const std::vector<char>& is_kept);
};

/// Edges with an odd number of triangles: zero when the surface encloses a volume.
std::size_t count_odd_edges(const SurfaceEdges& edges);

/// Joins vertices on open edges that coincide, or nearly so where that closes the surface.
/// Returns the number of vertices that disappear. Surfaces without open edges stay as they are,
/// whatever touches: equal positions alone are no reason to weld.
std::size_t weld_open_edges(TriMesh& mesh);

/// Removes triangles without area: those that repeat a vertex are dropped, caps are flipped into
/// their neighbour, others are dropped where that opens nothing. Returns how many there were;
/// `num_kept` of them are still there because dropping would have opened the surface.
std::size_t remove_degenerate_tris(WorkingSurface& surface, std::size_t& num_kept);

/// Reduces triangles on the same three vertices to one; equal numbers of opposite orientation
/// cancel, unless that opens the surface. What several closed shells share stays; with `keep_walls`
/// also the walls between solids that touch, which belong to both. Returns how many are dropped.
std::size_t remove_duplicate_tris(WorkingSurface& surface, bool keep_walls = false);

/// Closes every loop of open edges with a patch over its vertices; a fin's outline is none where it
/// is attached. The surface must be oriented. Triangles added have no source. Returns the number of
/// patches.
std::size_t fill_holes(WorkingSurface& surface);

struct UniteReport {
  std::size_t num_parts = 0;    ///< solids that were united with another
  std::size_t num_results = 0;  ///< what they became
  std::size_t num_apart = 0;    ///< solids that touch along edges or in points, and stay as many
  std::size_t num_closed = 0;   ///< results in which gaps were closed
  std::size_t num_failed = 0;   ///< solids that stay as they are: their union could not be made
};

/// Puts the surface of their union in the place of solids that overlap or touch. A solid is a
/// closed, consistently oriented piece with the cavities in it. The surface must be oriented.
/// `groups` are those of the input's triangles, or none: triangles of different ones stay apart.
/// Gaps narrower than `min_gap` (unit frame) are closed where much of a union consists of them.
UniteReport unite_parts(WorkingSurface& surface, Parts parts, double min_gap,
                        const IdVector<TriId, std::int32_t>& groups);

/// Closes slits without width: walls that lie on each other wholly, whatever their triangles, go.
/// Returns whether there were any. Leaves the surface as it is where that would open it.
bool close_slits(WorkingSurface& surface, Parts parts);

/// A part that is too small to be meant, or to be meshed.
struct SmallPart {
  Box3 box;              ///< in the unit frame
  bool is_void = false;  ///< a hole inside the solid
};

/// Removes components no longer than `least` in any direction (unit frame), solids and voids alike,
/// and voids thinner than a tenth of it, as long as a larger one remains, and those without
/// thickness. Returns the former.
std::vector<SmallPart> drop_small_parts(WorkingSurface& surface, double least);

/// Removes parts with the solid on both of their sides. They bound nothing, but sizing, features
/// and distances would follow them. The region with winding number above one half stays the same.
/// The surface must be oriented. Returns how many parts go.
std::size_t drop_hidden_parts(WorkingSurface& surface);

}  // namespace hexwright
