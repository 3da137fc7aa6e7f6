// Boundary vertices restricted to the tangents of what they are attached to.
#pragma once

#include "relax/state/fit_state.h"

namespace hexwright::relax {

/// While it lives, the boundary vertices of a region (one entry per vertex) move in the tangent
/// plane of the surface or along the tangent of their curve only (`hold_curves`: not at all);
/// corners stay. Requires up-to-date targets.
class SlideOnly {
 public:
  SlideOnly(FitState& state, const std::vector<char>& region, bool hold_curves = false)
      : state_(state) {
    for (VertId v : state.kind.ids()) {
      if (!region[v.index()] || !state.is_boundary(v) || state.move[v] != MoveIn::Space) continue;
      const bool is_held = hold_curves && state.kind[v] == VertKind::Curve;
      state.move[v] = is_held ? MoveIn::Point : hold_of(state.kind[v]).slide;
      state.axis[v] = normalized(state.direction[v]);
      verts_.push_back(v);
    }
  }
  ~SlideOnly() {
    for (VertId v : verts_) state_.move[v] = MoveIn::Space;
  }
  SlideOnly(const SlideOnly&) = delete;
  SlideOnly& operator=(const SlideOnly&) = delete;

 private:
  FitState& state_;
  std::vector<VertId> verts_;
};

}  // namespace hexwright::relax
