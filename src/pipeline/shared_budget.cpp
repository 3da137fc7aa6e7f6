// Counts, so that results do not depend on the machine.
#include "pipeline/shared_budget.h"

#include <algorithm>

#include "mesh/tri_measures.h"

namespace hexwright {
namespace {

constexpr double kReserve =
    0.5;  // of its share by area, that each part is left whatever others took

}  // namespace

SharedBudget::SharedBudget(const MeshOptions& options, const std::vector<TriMesh>& parts)
    : later_area_(parts.size() + 1, 0),
      hexes_(static_cast<double>(options.max_hexes)),
      loop_hexes_(static_cast<double>(options.max_loop_hexes)),
      cells_(static_cast<double>(options.sizing.max_cells)) {
  for (std::size_t k = parts.size(); k-- > 0;)
    later_area_[k] = later_area_[k + 1] + total_area(parts[k]);
  const double whole = later_area_.front();
  if (whole > 0)
    for (double& area : later_area_) area /= whole;
}

std::size_t SharedBudget::left(double all, double spent) const {
  const double later = kReserve * later_area_[next_ + 1];
  const double own = kReserve * later_area_[next_] - later;
  return static_cast<std::size_t>(std::max({1.0, own * all, all - spent - later * all}));
}

MeshOptions SharedBudget::allow(MeshOptions part) const {
  part.max_hexes = left(hexes_, spent_);
  part.max_loop_hexes = left(loop_hexes_, loop_spent_);
  part.sizing.max_cells = left(cells_, spent_);
  return part;
}

void SharedBudget::spend(const MeshResult& part) {
  spent_ += static_cast<double>(part.grid.num_cells());
  for (const RoundRecord& round : part.rounds)
    loop_spent_ += static_cast<double>(round.num_background);
  ++next_;
}

}  // namespace hexwright
