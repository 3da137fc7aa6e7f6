// What many local changes together may add to or take from a mesh's volume.
#pragma once

#include <algorithm>
#include <cmath>

namespace hexwright::relax {

class VolumeBudget {
 public:
  /// `most`: how far the sum of all changes may be from 0.
  explicit VolumeBudget(double most) : most_(most) {}

  /// Whether a change fits, in which case it is spent. Changes the other way give room back, and
  /// what leads back towards the first volume always fits.
  bool spend(double change) {
    const double total = spent_ + change;
    if (std::abs(total) > std::max(most_, std::abs(spent_))) return false;
    spent_ = total;
    return true;
  }

 private:
  double most_;
  double spent_ = 0;
};

}  // namespace hexwright::relax
