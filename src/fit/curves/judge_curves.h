// How well mapped curves are met in the end, and which are better dropped.
#pragma once

#include "hexwright/fit/fit.h"

#include "fit/curves/boundary_state.h"

namespace hexwright::fitting {

using relax::FitState;

/// Requires up-to-date targets.
struct CurveVerdicts {
  IdVector<CurveId, double> residual;  ///< largest distance of a vertex from its curve or corner,
                                       ///< in sizes; of mapped curves
  IdVector<CurveId, char> is_bad;      ///< mapped, and the residual is above the limit
  std::size_t num_bad = 0;
  double bad_length = 0;  ///< of the surface's curves that are bad or not mapped
};

/// A corner that is not reached counts against the shortest of the mapped curves that end there.
CurveVerdicts judge_curves(const FitState& state, const FeatureGraph& features,
                           const FeatureMapping& mapping, double limit = 0.5);

/// The features' part of the report.
void report_features(const FitState& state, const FeatureGraph& features,
                     const FeatureMapping& mapping, FitReport& report);

}  // namespace hexwright::fitting
