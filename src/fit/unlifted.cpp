// The lift starts before the last passes of a fit without it, some of which may have gained more.
#include "fit/unlifted.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "hexwright/quality/hex_quality.h"

namespace hexwright::fitting {

using namespace relax;

Unlifted::Unlifted(const FitState& state, std::vector<HexId> unproven, double goal)
    : positions_(state.mesh.positions),
      arc_(state.arc),
      offset_(state.offset),
      unproven_(std::move(unproven)),
      goal_(goal),
      quality_(measure(state.mesh, goal)) {}

Unlifted::Quality Unlifted::measure(const HexMesh& mesh, double goal) {
  Quality result = {.least = std::numeric_limits<double>::infinity()};
  for (const double quality : compute_scaled_jacobians(mesh)) {
    result.least = std::min(result.least, quality);
    const double shortfall = std::max(0.0, goal - quality);
    result.shortfall += shortfall * shortfall;
  }
  return result;
}

bool Unlifted::is_better_than(const FitState& lifted, std::size_t num_unproven) const {
  constexpr double kLittleLower = 0.95;
  const Quality quality = measure(lifted.mesh, goal_);
  const bool is_higher = quality.shortfall < quality_.shortfall;
  return quality.least < (is_higher ? kLittleLower : 1) * quality_.least &&
         num_unproven >= unproven_.size();
}

void Unlifted::restore(FitState& state) const {
  state.mesh.positions = positions_;
  state.arc = arc_;
  state.offset = offset_;
}

}  // namespace hexwright::fitting
