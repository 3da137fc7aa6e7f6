// Which regions of the boundary get a padding sheet, and which together.
#pragma once

#include "fit/curves/boundary_state.h"

namespace hexwright::fitting {

using relax::FitState;

using GroupId = Id<struct PaddingGroupTag>;  ///< regions that one sheet covers

struct PaddingGroups {
  IdVector<RegionId, GroupId> region_to_group;
  IdVector<GroupId, std::size_t> num_quads;
  IdVector<GroupId, int> num_needs;  ///< places that cannot do without a sheet under the group
};

/// A place that cannot do without a sheet under a group.
struct PaddingNeed {
  GroupId group;
  VertId a, b;              ///< an edge; b is invalid where the need is that of one vertex
  bool is_concave = false;  ///< an edge of a concave curve
};

/// Regions are united across curves that are convex over less than 90% of their length, and where
/// three or more groups meet in a way that a sheet's rim cannot follow.
/// `convex_share`: per curve, seen from outside the mesh.
PaddingGroups find_padding_groups(const FitState& state, const BoundaryState& boundary,
                                  const IdVector<CurveId, double>& convex_share);

/// The needs of groups once found, in a mesh that may have changed since; ascending by group. The
/// same place may be named twice.
std::vector<PaddingNeed> find_padding_needs(const FitState& state, const BoundaryState& boundary,
                                            const IdVector<CurveId, double>& convex_share,
                                            const PaddingGroups& groups);

}  // namespace hexwright::fitting
