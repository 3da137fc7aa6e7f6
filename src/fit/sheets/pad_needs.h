// Sheets around the few hexes of a group that are in need, instead of a layer under all of it.
#pragma once

#include <optional>

#include "fit/sheets/groups.h"

namespace hexwright::fitting {

/// What local sheets work on, besides the mesh and its boundary.
struct PaddingInput {
  const FeatureGraph& features;
  const PaddingGroups& groups;
  const IdVector<CurveId, double>& convex_share;  ///< per curve, seen from outside the mesh
};

/// Per group: hexes that sheets around what is in need would take; absent where they would not do:
/// a hex with a sheet around it at a concave curve meets it worse than a layer.
IdVector<GroupId, std::optional<std::size_t>> count_local_hexes(const FitState& state,
                                                                const BoundaryState& boundary,
                                                                const PaddingInput& input);

/// Pads around the hexes in need of the groups chosen, until none is left or nothing more can be
/// done. Where a sheet cannot pass a vertex its set takes in all hexes there. Returns the needs
/// that remain, per group.
IdVector<GroupId, int> pad_needs(FitState& state, BoundaryState& boundary,
                                 const PaddingInput& input,
                                 const IdVector<GroupId, char>& is_chosen);

}  // namespace hexwright::fitting
