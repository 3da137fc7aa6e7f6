// A sheet of hexes, and the plan of what its insertion does to a mesh and to the boundary's
// boundary.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "hexwright/geometry/feature_graph.h"
#include "hexwright/mesh/hex_adjacency.h"

namespace hexwright::fitting {

/// Quads that are doubled; the gap is filled with one hex per quad.
struct Sheet {
  static constexpr std::size_t kNone = ~std::size_t{0};

  /// Seen from the side that keeps the vertices, counter-clockwise; the hexes behind get copies.
  std::vector<std::array<VertId, 4>> quads;
  std::vector<HexId> behind;  ///< per quad: the hex behind, whose region tag the new one gets
  std::vector<VertId> verts;  ///< of the quads, ascending (set by collect_verts)

  void add_face(const HexMesh& mesh, const HexFace& face);
  /// The faces of `hexes` towards hexes that are not `is_in` (one entry per hex of the mesh).
  void add_inner_faces(const HexMesh& mesh, const HexNeighbors& neighbors,
                       std::span<const HexId> hexes, std::span<const char> is_in);
  void collect_verts();
  /// Place of a vertex in `verts`, or kNone.
  std::size_t index_of(VertId v) const;
};

/// A place on a feature curve.
struct CurvePlace {
  CurveId curve;  ///< invalid: none
  double arc = 0;
};

/// What the insertion of a sheet does. On the boundary some quads go with the copies and the others
/// keep their vertices; between them runs the rim, where the sheet's hexes come to the boundary.
struct SheetPlan {
  Sheet sheet;
  std::vector<Vec3> directions;  ///< per sheet vertex: unit, sees its quads from in front
  std::vector<char> takes_copy;  ///< per hex of the mesh: is behind; empty: all at the sheet are
  std::vector<char> follows;     ///< per boundary quad: goes with the copies
  std::vector<CurvePlace> on_curve;  ///< per sheet vertex on the rim: the curve that its copy is
                                     ///< on; empty: no copy is on one
};

}  // namespace hexwright::fitting
