// The boundary of the present mesh and the features on it: which edges run on curves, which region
// each quad is in. Kept up to date by everything that inserts sheets.
#pragma once

#include <optional>
#include <vector>

#include "fit/curves/regions.h"
#include "relax/state/fit_state.h"

namespace hexwright::fitting {

using relax::BoundaryEdgeId;
using relax::BoundaryGraph;
using relax::BoundaryQuads;
using relax::FitState;

/// The region of a quad that is known by its vertices.
struct QuadLabel {
  std::array<VertId, 4> verts;  ///< ascending
  RegionId region;
};

struct BoundaryState {
  BoundaryGraph graph;                              ///< of FitState::quads
  IdVector<BoundaryEdgeId, CurveId> edge_to_curve;  ///< invalid where no curve runs
  IdVector<QuadId, RegionId> quad_to_region;        ///< per FitState::quads
  IdVector<RegionId, PatchId> region_to_patch;      ///< invalid: none has a majority

  bool is_marked(BoundaryEdgeId e) const { return edge_to_curve[e].is_valid(); }
  /// The edges on curves, ascending by their ascending vertices.
  std::vector<LabeledEdge> marked_edges() const;
  /// What is left after the state's connectivity changed: marks of edges that are on its boundary,
  /// regions of quads that have a label, in any order.
  void rebuild(const FitState& state, const std::vector<LabeledEdge>& marked,
               std::vector<QuadLabel> labels);
  /// First disagreement with the mesh: a quad without a region, neighbours across an unmarked edge
  /// in different ones, an edge marked between others than its curve's vertices, a curve vertex
  /// that is not passed by exactly its curve.
  std::optional<Issue> find_problem(const FitState& state) const;
};

/// The state's boundary as the mapping sees it; valid while the state is not rebuilt.
BoundaryQuads boundary_view(const FitState& state);

struct AttachedFeatures {
  FeatureMapping mapping;
  BoundaryState boundary;
  PatchIndex patches;  ///< the surface's patches between the mapped curves
};

/// Maps the features to the state's boundary, finds the patches between the mapped curves, and
/// writes kind, patch, curve, arc and feature_point of every boundary vertex (what an earlier
/// mapping wrote is forgotten).
AttachedFeatures attach_features(FitState& state, const SurfaceTree& tree,
                                 const FeatureGraph& features, const FeatureMapOptions& options);

/// What users get: patch of each boundary quad, curve of each marked edge, corners. A quad of a
/// region without a patch gets that of the nearest triangle that faces its way.
BoundaryLabels make_labels(const FitState& state, const BoundaryState& boundary,
                           const SurfaceTree& tree, const PatchIndex& patches);

}  // namespace hexwright::fitting
