// Sheets where the fit shows that a squeezed quad cannot do without.
#pragma once

#include "hexwright/base/context.h"

#include "fit/sheets/squeezed.h"

namespace hexwright::fitting {

using relax::FitTarget;

struct FailedOptions {
  double low = 0.2;         ///< scaled Jacobian around a curve vertex below which it has failed
  double stuck = 0.02;      ///< residual, in sizes, above which it has
  double worthwhile = 0.8;  ///< sheets stay if at most this share of the failed vertices is left
  int rings = 3;            ///< around the new vertices, that are fitted anew
};

/// Of a fitted state: sheets around the squeezed quads at curve and corner vertices that failed,
/// then the fit of their surroundings, from a low to a high weight, and a refit. When that mends
/// few of them everything is left as it was: the sheets would cost hexes and quality for nothing.
SqueezedReport pad_failed_quads(FitState& state, BoundaryState& boundary, const FitTarget& target,
                                const FailedOptions& options, const Context& context);

}  // namespace hexwright::fitting
