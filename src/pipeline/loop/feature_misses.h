// Where finer cells can help the mesh to follow the surface's curves and corners.
#pragma once

#include <vector>

#include "hexwright/grid/grid.h"
#include "hexwright/quality/judge.h"

namespace hexwright {

/// A curve of which less than this share is followed has no path of its own in the mesh.
constexpr double kFollowedShare = 0.5;
/// A curve needs so many cells along it to get a path of edges.
constexpr double kCellsPerCurve = 8;

/// No curve needs cells below this multiple of the tolerance for features: what is shorter or
/// nearer to another than that can hardly be told from it.
constexpr double kLeastFeatureCell = 2;

/// Cells that suffice for a curve to be followed: a path's worth along it, and edges that depart
/// from its mean curvature by less than `tolerance` (a length).
double sufficient_cell_size(const CurveRecovery& curve, double tolerance);

/// Of the missed places those whose leaf is coarser than `deepest` and, on a curve without a path,
/// than sufficient: what has no path in sufficient cells is in the way of other curves, or noise,
/// and refining along it has no end.
std::vector<Vec3> find_refinable_features(const Grid& grid, const FeatureRecovery& features,
                                          double tolerance, int deepest);

}  // namespace hexwright
