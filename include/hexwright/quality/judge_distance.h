// The judge's distance alone, and how near to it its upper bound should be.
#pragma once

#include "hexwright/quality/judge.h"

namespace hexwright {

/// Between the largest distance and its upper bound (JudgeOptions::bound_gap), as a share of the
/// tolerance.
constexpr double kBoundOfTolerance = 0.02;

/// Against a target, in its coordinates, as judge() measures it.
SurfaceDistance judge_distance(const HexMesh& mesh, const Target& target,
                               const JudgeOptions& options);

}  // namespace hexwright
