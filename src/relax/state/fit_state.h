// What the passes of the fit work on: the mesh, its adjacency, and per vertex where it belongs on
// the surface and which target it is pulled to.
#pragma once

#include <limits>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/geometry/feature_graph.h"
#include "hexwright/geometry/patch_index.h"
#include "hexwright/geometry/side.h"

#include "relax/kernel/body.h"

namespace hexwright::relax {

/// Where and how a Surface vertex last looked for its target: unless one of these changes, it would
/// find the same again.
struct TargetQuery {
  Vec3 from{std::numeric_limits<double>::infinity(), 0, 0};
  double offset = 0;
  PatchId patch;
};

/// Copied as a whole to try a variant and go back.
struct FitState : Body {
  explicit FitState(HexMesh hex_mesh) : Body(std::move(hex_mesh)) {
    mesh.mid_nodes.reset();  // vertices are about to move
    rebuild();
  }

  /// Tags with Side::Both; any other is one more object, beside the first and the outside.
  static constexpr std::int32_t kInsideRegion = 1, kOutsideRegion = 2;

  Side side = Side::Inside;  ///< of the surface that the hexes are on

  // Where each vertex belongs, beside its kind (set by the mapping; `rebuild` makes new boundary
  // vertices Surface).
  IdVector<VertId, PatchId> patch;         ///< of Surface vertices; invalid = anywhere
  IdVector<VertId, CurveId> curve;         ///< of Curve vertices
  IdVector<VertId, double> arc;            ///< of Curve vertices: arc length on the curve
  IdVector<VertId, VertId> feature_point;  ///< of Corner vertices: the surface's vertex
  /// Of Surface vertices: how far outwards from the surface they belong (see balance.h).
  IdVector<VertId, double> offset;

  /// Of Surface vertices: what target and direction (set by update_targets) are for.
  IdVector<VertId, TargetQuery> query;

  // Derived from the mesh by rebuild(), as the body is; sizes are those of boundary edges there.
  HexNeighbors neighbors;
  /// Quads to be fitted to the surface, counter-clockwise seen from the object's outside; quad q is
  /// quad_face[q]. With Side::Both they are the faces between two regions, on the side of the
  /// object, of two objects on that of the lower tag.
  std::vector<std::array<VertId, 4>> quads;
  std::vector<HexFace> quad_face;

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
