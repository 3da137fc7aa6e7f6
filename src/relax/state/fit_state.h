// What the passes of the fit work on: the mesh, its adjacency, and per vertex where it belongs on
// the surface and which target it is pulled to.
#pragma once

#include <limits>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/geometry/feature_graph.h"
#include "hexwright/geometry/patch_index.h"
#include "hexwright/geometry/side.h"
#include "hexwright/mesh/hex_adjacency.h"

#include "relax/kernel/vertex_newton.h"

namespace hexwright::relax {

/// What part of the surface a vertex belongs to. Interior vertices belong to none.
enum class VertKind : std::uint8_t { Interior, Surface, Curve, Corner };

/// Where and how a Surface vertex last looked for its target: unless one of these changes, it would
/// find the same again.
struct TargetQuery {
  Vec3 from{std::numeric_limits<double>::infinity(), 0, 0};
  double offset = 0;
  PatchId patch;
};

/// Copied as a whole to try a variant and go back.
struct FitState {
  explicit FitState(HexMesh hex_mesh) : mesh(std::move(hex_mesh)) {
    mesh.mid_nodes.reset();  // vertices are about to move
    rebuild();
  }

  static constexpr std::int32_t kInsideRegion = 1, kOutsideRegion = 2;  ///< tags with Side::Both

  HexMesh mesh;
  Side side = Side::Inside;  ///< of the surface that the hexes are on

  // Where each vertex belongs (set by the mapping; `rebuild` makes new boundary vertices Surface).
  IdVector<VertId, VertKind> kind;
  IdVector<VertId, PatchId> patch;         ///< of Surface vertices; invalid = anywhere
  IdVector<VertId, CurveId> curve;         ///< of Curve vertices
  IdVector<VertId, double> arc;            ///< of Curve vertices: arc length on the curve
  IdVector<VertId, VertId> feature_point;  ///< of Corner vertices: the surface's vertex
  /// Of Surface vertices: how far outwards from the surface they belong (see balance.h).
  IdVector<VertId, double> offset;

  // What each vertex is pulled to (set by update_targets).
  IdVector<VertId, Vec3> target;
  IdVector<VertId, Vec3> direction;     ///< Surface: normal; Curve: tangent (maybe shorter than 1)
  IdVector<VertId, TargetQuery> query;  ///< of Surface vertices: what target and direction are for
  IdVector<VertId, MoveIn> move;        ///< vertices on a fixed outer boundary move in it only
  IdVector<VertId, Vec3> axis;          ///< of that plane or line
  IdVector<VertId, double> size;        ///< h: mean length of boundary edges (inside: of all edges)
  IdVector<VertId, char> is_dirty;      ///< worth solving: it, a neighbour or its target moved

  // Derived from the mesh by rebuild().
  VertToHex vert_to_hex;
  VertexStars stars;
  VertexColors colors;
  HexNeighbors neighbors;
  /// Quads to be fitted to the surface, counter-clockwise seen from the object's outside; quad q is
  /// quad_face[q]. With Side::Both they are the faces of region kInsideRegion towards the other.
  std::vector<std::array<VertId, 4>> quads;
  std::vector<HexFace> quad_face;

  std::size_t num_verts() const { return mesh.num_verts(); }
  bool is_boundary(VertId v) const { return kind[v] != VertKind::Interior; }
  /// Distance from the vertex to what it is attached to, in units of its size.
  double residual(VertId v) const;

  /// Whether a hex's face is to be fitted to the surface: towards nothing, or between the two
  /// sides. Faces of the fixed outer boundary are not.
  bool is_fitted_face(const HexFace& face) const;

  /// Recomputes everything derived after the connectivity changed. Per-vertex arrays grow to the
  /// new vertices; vertices on quads that are Interior become Surface; sizes are recomputed, all
  /// vertices become dirty.
  void rebuild();
  /// Recomputes `size` from the present positions.
  void update_sizes();
  /// 1 per hex inside the object (all or none unless Side::Both).
  std::vector<char> inside_hexes() const;
  void mark_all_dirty() { is_dirty.assign(num_verts(), 1); }
  /// Grows the per-vertex arrays to the number of positions (called by rebuild).
  void resize_arrays();

 private:
  void find_quads();
};

/// The surface and its features as the passes see them.
struct FitTarget {
  const SurfaceTree& tree;
  const FeatureGraph* features = nullptr;
  const PatchIndex* patches = nullptr;  ///< between the mapped curves
};

}  // namespace hexwright::relax
