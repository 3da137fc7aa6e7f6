// The features on the present mesh: which edges run on curves, which region each boundary quad is
// in. Kept up to date by everything that inserts layers.
#pragma once

#include <optional>
#include <vector>

#include "fit/curves/regions.h"
#include "relax/fit_state.h"

namespace hexwright::fitting {

using relax::BoundaryQuads;
using relax::FitState;

struct FeatureMarks {
  std::vector<LabeledEdge> edges;               ///< on curves, sorted by their ascending vertices
  IdVector<QuadId, RegionId> quad_to_region;    ///< per FitState::quads
  IdVector<RegionId, PatchId> region_to_patch;  ///< invalid: none has a majority
};

/// The state's boundary as the mapping sees it; valid while the state is not rebuilt.
BoundaryQuads boundary_view(const FitState& state);

struct AttachedFeatures {
  FeatureMapping mapping;
  FeatureMarks marks;
};

/// Maps the features to the state's boundary, gives the tree the patches between the mapped curves,
/// and writes kind, patch, curve, arc and feature_point of every boundary vertex (what an earlier
/// mapping wrote is forgotten).
AttachedFeatures attach_features(FitState& state, SurfaceTree& tree, const FeatureGraph& features,
                                 const FeatureMapOptions& options);

/// Gives Surface vertices the patch of their region.
void assign_patches(FitState& state, const FeatureMarks& marks);

/// Regions of the quads after the connectivity changed: each quad's region is looked up by its
/// vertices in `labels` (sorted by vertices, each quad's ascending).
struct QuadLabel {
  std::array<VertId, 4> verts;  ///< ascending
  RegionId region;
};
std::array<VertId, 4> sorted_verts(std::array<VertId, 4> quad);
void restore_regions(const FitState& state, std::vector<QuadLabel> labels, FeatureMarks& marks);

/// First disagreement between the marks and the mesh: a quad without a region, neighbours across an
/// unmarked edge in different ones, a marked edge off the boundary, a curve vertex that is not
/// passed by exactly its curve.
std::optional<Issue> find_problem(const FitState& state, const FeatureMarks& marks);

/// What users get: patch of each boundary quad, curve of each marked edge, corners. A quad of a
/// region without a patch gets that of the nearest triangle that faces its way.
BoundaryLabels make_labels(const FitState& state, const FeatureMarks& marks,
                           const SurfaceTree& tree);

}  // namespace hexwright::fitting
