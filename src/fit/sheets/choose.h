// Padding only where the boundary needs it: one-sided sheets under groups of regions, ending on
// convex curves, instead of a layer under everything.
#pragma once

#include "hexwright/base/context.h"

#include "fit/curves/boundary_state.h"

namespace hexwright::fitting {

using relax::FitState;
using relax::FitTarget;

struct SelectivePaddingReport {
  std::size_t num_groups = 0;        ///< groups of regions
  std::size_t num_needed = 0;        ///< of them need a sheet
  std::size_t num_sheets = 0;        ///< got one
  std::size_t num_restarts = 0;      ///< times the order was changed because a sheet did not fit
  std::size_t num_failed_quads = 0;  ///< quads of groups that need a sheet and got none
};

struct SelectivePadding {
  FitState state;
  BoundaryState boundary;
  SelectivePaddingReport report;
};

/// `carved`: the unpadded mesh. `scaffold`: the same with one layer everywhere, fitted and mapped;
/// its boundary has the vertex ids of the carved mesh's. Curves, kinds and regions are taken over
/// from it, everything else is discarded. Every group that needs a sheet gets one where a valid one
/// exists; the smallest first.
SelectivePadding choose_sheets(const FitState& carved, const FitState& scaffold,
                               const BoundaryState& scaffold_boundary, const FitTarget& target,
                               const Context& context);

}  // namespace hexwright::fitting
