// Where boundary vertices are pulled to.
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "relax/state/fit_state.h"

namespace hexwright::relax {

/// Sets target and direction of the boundary vertices (of those with only[v] != 0 when `only` is
/// not empty) from their present positions, and marks a vertex dirty when its target moved.
/// `hold` in [0, 1] holds curve vertices at their parameter (see update_feature_target).
void update_targets(FitState& state, const FitTarget& target, double hold,
                    std::span<const char> only = {});

/// Who looks for its place on the surface, and how.
struct SurfaceSeeker {
  Vec3 position;
  Vec3 normal;  ///< unit, outwards: matches face it where that leads not far away
  double size = 0;
  PatchId patch;      ///< invalid = anywhere
  double offset = 0;  ///< how far outwards from the surface it belongs
  double bound = std::numeric_limits<double>::infinity();  ///< a match is likely no farther
};

struct SurfaceMatch {
  Vec3 target;
  Vec3 direction;  ///< the surface's normal there, on the seeker's outer side
};

/// Absent when the surface is empty.
std::optional<SurfaceMatch> match_surface(const SurfaceSeeker& seeker, const FitTarget& target);

/// A vertex that moved by less than this, in h, since it last looked keeps its target: what it is
/// pulled to is a plane, off the surface by less than half the curvature times the square of the
/// way.
constexpr double kSamePlace = 0.01;

}  // namespace hexwright::relax
