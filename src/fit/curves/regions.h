// Regions: the boundary quads between mapped curves, and the surface patch each stands for.
#pragma once

#include <vector>

#include "hexwright/geometry/patch_index.h"
#include "hexwright/mesh/hex_mesh.h"

#include "fit/curves/map_features.h"

namespace hexwright::fitting {

using relax::BoundaryEdgeId;
using relax::BoundaryGraph;
using relax::BoundaryQuads;

using RegionId = Id<struct RegionTag>;  ///< connected set of boundary quads between marked edges

/// Mesh edges on curves, sorted by their (ascending) vertices. The labels of a HexMesh have the
/// same form.
std::vector<LabeledEdge> collect_marked_edges(const FeatureMapping& mapping);

/// Curve of each boundary edge; invalid where none runs.
IdVector<BoundaryEdgeId, CurveId> mark_edges(const BoundaryGraph& graph,
                                             const std::vector<LabeledEdge>& marked);

struct RegionMap {
  IdVector<QuadId, RegionId> quad_to_region;
  IdVector<RegionId, PatchId> region_to_patch;  ///< invalid where no patch has a majority
  std::size_t num_regions() const { return region_to_patch.size(); }
};

/// Flood fill across edges that no curve marks; regions are numbered by their first quad.
RegionMap compute_regions(const BoundaryGraph& graph,
                          const IdVector<BoundaryEdgeId, CurveId>& edge_to_curve);

/// The patch nearest to a quad's centre among triangles that face its way, or among all when none
/// does.
PatchId nearest_patch(const BoundaryQuads& boundary, const SurfaceTree& tree,
                      const PatchIndex& patches, QuadId q);

/// Gives each region the patch that more than half of its area lies nearest to, among the patches
/// between the mapped curves.
void vote_patches(const BoundaryQuads& boundary, const SurfaceTree& tree, const PatchIndex& patches,
                  RegionMap& regions);

/// Per curve: 1 when mapped; what compute_patches calls a barrier.
std::vector<char> mapped_curves(const FeatureMapping& mapping);

}  // namespace hexwright::fitting
