// Which regions of the boundary get a padding sheet, and which together.
#pragma once

#include "fit/feature_layers.h"

namespace hexwright::fitting {

using GroupId = Id<struct PaddingGroupTag>;  ///< regions that one sheet covers

struct PaddingGroups {
  IdVector<RegionId, GroupId> region_to_group;
  IdVector<GroupId, std::size_t> num_quads;
  IdVector<GroupId, int> num_needs;  ///< places that cannot do without a sheet under the group
};

/// Regions are united across curves that are convex over less than 90% of their length, and where
/// three or more groups meet in a way that a sheet's rim cannot follow.
/// `convex_share`: per curve, seen from outside the mesh.
PaddingGroups find_padding_groups(const FitState& state, const FeatureMarks& marks,
                                  const MarkedGraph& marked,
                                  const IdVector<CurveId, double>& convex_share);

}  // namespace hexwright::fitting
