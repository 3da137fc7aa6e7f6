// Maps the feature curves of a surface to disjoint edge paths of a hex mesh's boundary.
//
// Based on: McMurchie, Ebeling, "PathFinder: A Negotiation-Based Performance-Driven Router for
// FPGAs", 1995 (negotiated congestion). Differs: corners move when their surroundings stay
// congested, and curves that cannot be separated are dropped instead of failing the whole.
#pragma once

#include <string>
#include <vector>

#include "hexwright/geometry/feature_graph.h"

#include "relax/kernel/boundary_quads.h"

namespace hexwright::fitting {

using relax::BoundaryQuads;

struct FeatureMapOptions {
  double corner_reach = 2.5;  ///< a corner's vertex is at most so many edge lengths away
  double tube_reach = 2.2;    ///< so is every vertex of a path from its curve
  /// Along wedges both are raised by what the carve leaves of them, see wedge_reach(); to this.
  double max_wedge_reach = 6;
  double distance_weight = 10;  ///< cost factor of squared distance (in edge lengths) to the curve
  int max_iterations = 45;
  double min_edges = 4;  ///< freely ending curves and loops of fewer edges are left out
  /// Curves that must not be mapped; empty or one entry per curve.
  IdVector<CurveId, char> is_banned;
};

/// The edge path that stands for a curve.
struct CurvePath {
  std::vector<VertId> verts;  ///< mesh vertices from the curve's first to its last vertex; a loop
                              ///< repeats the first; empty when not mapped
  std::vector<double> arcs;   ///< per vertex, ascending; a loop's may start off 0 and pass length()
  std::string reason;         ///< why it was not mapped
  bool is_mapped() const { return !verts.empty(); }
};

struct FeatureMapping {
  IdVector<CurveId, CurvePath> curves;
  std::vector<VertId> corner_verts;  ///< per FeatureGraph corner; invalid when no mapped curve ends
                                     ///< there
  int num_iterations = 0;            ///< rounds of the negotiation
  std::size_t num_chords = 0;        ///< detours around a quad that were shortened
};

/// Paths share no vertex but corners, and no edge. Deterministic.
FeatureMapping map_features(const BoundaryQuads& boundary, const TriMesh& surface,
                            const FeatureGraph& features, const FeatureMapOptions& options);

}  // namespace hexwright::fitting
