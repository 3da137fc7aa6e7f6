// From the triangles of a file to a surface the pipeline can trust: welded, without degenerate or
// stray elements, oriented as well as it can be, with everything that was found said.
#pragma once

#include <string>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

/// What becomes of solids that overlap or touch.
enum class Parts {
  Unite,     ///< their union is the object
  Separate,  ///< those that overlap are united, those that only touch are left as they are
  AsIs       ///< all surfaces stay; inside is decided by the winding number
};

struct PrepareOptions {
  Parts parts = Parts::Unite;
  /// Components no longer than this in any direction are left out, with a warning, and voids
  /// inside the solid are filled: a share of the diagonal.
  double min_part = 0;
  /// Where solids that overlap or touch nearly coincide elsewhere, gaps between them that are
  /// narrower are closed: a share of the diagonal.
  double min_gap = 0;
};

/// What was found and changed. Counts are of the input.
struct SurfaceDiagnosis {
  std::size_t num_welded_verts = 0;     ///< vertices merged into an equal or nearly equal one
  std::size_t num_degenerate_tris = 0;  ///< dropped: zero area or repeated vertex
  std::size_t num_duplicate_tris = 0;   ///< dropped: same three vertices as an earlier one
  std::size_t num_boundary_edges = 0;   ///< edges with one triangle, before holes were closed
  std::size_t num_filled_holes = 0;     ///< loops of such edges that a patch closes now
  std::size_t num_nonmanifold_edges =
      0;                             ///< after the clean-up: edges with three or more triangles
  std::size_t num_flipped_tris = 0;  ///< re-oriented to agree with their component
  std::size_t num_hidden_parts = 0;  ///< dropped: walls and shells inside the solid
  std::size_t num_united_parts = 0;  ///< solids that overlapped or touched another
  std::size_t num_unions = 0;        ///< solids that they were united into
  std::size_t num_gaps_closed = 0;   ///< unions with gaps narrower than PrepareOptions::min_gap
  std::size_t num_small_parts = 0;   ///< left out by PrepareOptions::min_part
  std::size_t num_small_voids = 0;   ///< filled by it
  bool is_flipped_whole = false;     ///< the surface pointed inwards and was turned as a whole
  bool is_closed = false;  ///< now every edge has exactly two, consistently oriented triangles
  std::vector<std::string> notes;     ///< what was done as it should be: one sentence each
  std::vector<std::string> warnings;  ///< what may not be meant: one sentence each
};

struct PreparedSurface {
  TriMesh mesh;  ///< with the groups of the input
  IdVector<TriId, TriId>
      source_tri;  ///< per triangle: its id in the input; invalid where it closes a hole
  SurfaceDiagnosis diagnosis;
};

/// Welds, cleans, orients, closes holes, and unites parts. Tolerances are relative to the box's
/// diagonal. Throws Error{BadGeometry} when nothing remains to mesh: no triangles, coordinates not
/// finite (names the vertex), extent so large or small that doubles overflow or vanish, all
/// triangles degenerate, or no enclosed volume (a flat sheet). The message says what to do.
PreparedSurface prepare_surface(const TriMesh& input, const PrepareOptions& options,
                                const Context& context);
inline PreparedSurface prepare_surface(const TriMesh& input, const Context& context) {
  return prepare_surface(input, {}, context);
}

}  // namespace hexwright
