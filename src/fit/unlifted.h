// What a lift is measured by, and gone back to where it costs more than it brings.
#pragma once

#include <vector>

#include "relax/state/fit_state.h"

namespace hexwright::fitting {

class Unlifted {
 public:
  Unlifted() = default;
  /// `goal`: the lift's, of the least scaled Jacobian.
  Unlifted(const relax::FitState& state, std::vector<HexId> unproven, double goal);

  /// Whether what was lifted from it is worse: its least is lower, by more than 5% where the sum of
  /// squared shortfalls below the goal fell, and no more hexes are proven.
  bool is_better_than(const relax::FitState& lifted, std::size_t num_unproven) const;
  /// Puts the state of the same mesh back. Its targets have to be updated.
  void restore(relax::FitState& state) const;

  const std::vector<HexId>& unproven() const { return unproven_; }

 private:
  struct Quality {
    double least = 0;      // scaled Jacobian
    double shortfall = 0;  // the sum of (goal - scaled Jacobian)^2 over hexes below the goal
  };
  static Quality measure(const HexMesh& mesh, double goal);

  IdVector<VertId, Vec3> positions_;
  IdVector<VertId, double> arc_, offset_;
  std::vector<HexId> unproven_;
  double goal_ = 0;
  Quality quality_;
};

}  // namespace hexwright::fitting
