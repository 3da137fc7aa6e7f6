// How far a mesh's boundary is from the surface it stands for, both ways.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "hexwright/geometry/similarity.h"
#include "hexwright/geometry/surface_tree.h"
#include "hexwright/mesh/hex_mesh.h"

namespace hexwright {

/// Which quads of a hex mesh stand for the surface.
enum class JudgedQuads {
  Boundary,  ///< the whole boundary
  Labeled    ///< the labelled quads that carry a patch: leaves out the box around an outside mesh
             ///< (until its sides are named), and finds the interface of a mesh of both sides
};

/// The quads, counter-clockwise seen from outside.
std::vector<std::array<VertId, 4>> collect_judged_quads(const HexMesh& mesh, JudgedQuads which);

struct DistanceOptions {
  JudgedQuads quads = JudgedQuads::Boundary;
  /// Distance between samples, share of the surface's diagonal; on a boundary more than three times
  /// as large, share of its own.
  double spacing = 0.004;
  double hot_threshold =
      0;  ///< collect samples farther than this (share of the diagonal) into `hot`; 0 = none
  /// Leaves out far samples where surface and solid part by right: on the surface, those that do
  /// not bound the solid (overlapped parts, by the winding number on both sides); on the mesh,
  /// those where the winding number closes a hole of the surface.
  bool solid_only = true;
  /// What the mesh fills: samples on the box's sides or beyond are left out too.
  std::optional<Box3> domain = {};
  /// With upper bounds of the largest distances, so near to the distances found (share of the
  /// diagonal); 0 = without. None of meshes with nodes inside of faces (MidNodes::inner).
  double bound_gap = 0;
};

/// No point is farther: of the surface's triangles and of the patches that the boundary's quads
/// are to solvers (bilinear, or of second order). Shares of the diagonal.
struct DistanceUpperBound {
  double to_mesh = 0, to_surface = 0;
  /// Not of small pieces with their centre left out by solid_only: as far as samples tell.
  bool has_excuses = false;
  double two_way() const { return std::max(to_mesh, to_surface); }
};

/// Distances as shares of the surface's bounding-box diagonal.
struct SurfaceDistance {
  double max_to_mesh = 0, mean_to_mesh = 0;        ///< from the surface to the mesh's boundary
  double max_to_surface = 0, mean_to_surface = 0;  ///< from the mesh's boundary to the surface
  /// With a DistanceOptions::bound_gap. The maxima then are lower bounds for the same patches.
  std::optional<DistanceUpperBound> upper;
  Vec3 worst_on_surface, worst_on_mesh;  ///< where the maxima are reached
  /// Of the surface's samples, by area: left out by solid_only and domain.
  double ignored_share = 0;
  std::vector<Vec3> hot;  ///< samples farther than hot_threshold
  double max_two_way() const { return std::max(max_to_mesh, max_to_surface); }
  double mean_two_way() const { return std::max(mean_to_mesh, mean_to_surface); }
  void to_world(const Similarity& frame);
};

/// Samples vertices, edges and the insides of triangles and boundary quads (each quad split about
/// its centre into four).
SurfaceDistance measure_distance(const HexMesh& mesh, const SurfaceTree& surface,
                                 const DistanceOptions& options);

/// The boundary of a hex mesh as triangles (four per quad, about its centre; more for curved quads
/// of second order); vertices of the mesh come first.
TriMesh boundary_triangles(const HexMesh& mesh);
TriMesh triangulate_quads(const HexMesh& mesh, const std::vector<std::array<VertId, 4>>& quads);

}  // namespace hexwright
