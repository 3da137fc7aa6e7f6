// Brings inverted hexes back to positive corner determinants, where vertices that may move can.
#pragma once

#include <vector>

#include "hexwright/base/context.h"

#include "relax/state/fit_state.h"

namespace hexwright::relax {

struct UntangleOptions {
  /// Regularisations taken in turn, as shares of h^3. Small ones are for hexes that are much longer
  /// one way than another, whose determinants a large one would hide.
  std::vector<double> shares = {0.1, 0.01};
  int max_rounds = 40, sweeps = 10;
  double low = 0;  ///< scaled Jacobian up to which a hex counts as tangled
  /// Given, boundary vertices glide on it, pulled with `weight` (in units of 1 / h^2); else they
  /// follow the energy and their `move` alone.
  const FitTarget* target = nullptr;
  double weight = 0;
};

/// Works on growing surroundings of the inverted hexes with a regularised energy. Returns how many
/// hexes have a corner determinant that is not positive (or as options.low says) in the end.
std::size_t untangle(FitState& state, const UntangleOptions& options, const Context& context);
inline std::size_t untangle(FitState& state, const Context& context) {
  return untangle(state, {}, context);
}

}  // namespace hexwright::relax
