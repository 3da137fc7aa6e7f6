// Layers that end on feature curves: what a sheet of hexes inserted behind a set does to the marks,
// and the pillows under regions whose quads are squeezed flat between two pieces of a curve.
//
// Based on: Marechal, "Advances in octree-based all-hexahedral mesh generation: handling sharp
// features", 18th International Meshing Roundtable, 2009. Differs: pillows may cover only the
// surroundings of the squeezed quads.
#pragma once

#include <numbers>

#include "fit/curves/feature_marks.h"

namespace hexwright::fitting {

/// A boundary graph with the present marks.
struct MarkedGraph {
  explicit MarkedGraph(const FitState& state, const FeatureMarks& marks);
  BoundaryGraph graph;
  IdVector<BoundaryEdgeId, CurveId> edge_to_curve;
  bool is_marked(BoundaryEdgeId e) const { return edge_to_curve[e].is_valid(); }
};

/// Quads with two consecutive marked edges at a curve vertex, or at a corner with an angle above
/// `corner_angle` (radians): on the surface they would have a straight or reflex corner.
std::vector<QuadId> find_squeezed_quads(const FitState& state, const MarkedGraph& marked,
                                        double corner_angle);
/// The same for one quad: its corners that are squeezed, as bits of the local vertices.
unsigned squeezed_corners(const FitState& state, const MarkedGraph& marked, QuadId q,
                          double corner_angle);

struct PillowOptions {
  bool whole_regions = true;  ///< pillow all of a region with squeezed quads; else only around them
  int ring = 1;               ///< vertex rings around squeezed quads, when not whole regions
  double corner_angle = 140 * std::numbers::pi / 180;  ///< radians
  /// Squeezed corners at other vertices are left alone; empty = none are. One entry per vertex.
  std::vector<char> is_wanted;
  double min_cosine = 0.02;  ///< least visibility of the sheet at each of its vertices
};

struct PillowReport {
  std::size_t num_pillows = 0, num_skipped = 0, num_hexes = 0;
};

/// Pillows what is squeezed; the state is rebuilt. Sizes are those of the present positions.
PillowReport pillow_squeezed_quads(FitState& state, FeatureMarks& marks,
                                   const PillowOptions& options);

}  // namespace hexwright::fitting
