// What a joint solve must not pay with: the middles of quads and of their edges stay near the
// surface, those of curve edges near their curve, and no hex loses its proof of a positive
// Jacobian.
#pragma once

#include <span>
#include <vector>

#include "relax/joint/patch.h"

namespace hexwright::relax {

/// Of one region, relative to where it starts.
class JointGuard {
 public:
  /// Measures the state's positions. Keeps references.
  JointGuard(const FitState& state, const FitTarget& target, const JointRegion& region);

  /// Whether the stage allows these positions of all local vertices.
  bool allows(std::span<const Vec3> positions, const JointStage& stage) const;

 private:
  /// The mean of the corners of a quad, or of an edge's ends (each twice).
  struct Middle {
    std::array<LocalVert, 4> verts{};
    CurveId curve;  ///< valid: of an edge that follows this curve
    double at_first = 0;
  };
  void find_middles();
  void add_middle(const std::array<LocalVert, 4>& verts, CurveId curve);
  CurveId curve_along(LocalVert a, LocalVert b) const;
  /// Infinity when it is beyond the limit.
  double distance_of(const Middle& middle, std::span<const Vec3> positions, double limit) const;
  int count_unproven(std::span<const Vec3> positions) const;

  const FitState& state_;
  const FitTarget& target_;
  const JointRegion& region_;
  std::vector<Middle> middles_;
  int unproven_ = 0;
};

}  // namespace hexwright::relax
