// Where curves run so close together that cells of the grid cannot tell them apart.
#pragma once

#include <span>
#include <vector>

#include "hexwright/geometry/feature_graph.h"
#include "hexwright/grid/size_field.h"
#include "hexwright/quality/judge.h"

namespace hexwright {

/// A place and the edge of the cells that it needs.
struct SizedPlace {
  Vec3 position;
  double cell_size = 0;
};

/// The missed places, on curves without a path, that have another curve within a quarter of
/// their leaf's edge: a neck or slit between the two, which the grid pierces or bridges, so that
/// there is no path for either. Its cells should be as small as the gap, but need not be smaller
/// than `least_size`. Curves that meet at a corner are close to each other near it: these count
/// only where the distance from the corner is more than three times the gap.
std::vector<SizedPlace> find_crowded_misses(const Grid& grid, const TriMesh& surface,
                                            const FeatureGraph& features,
                                            const FeatureRecovery& recovery, double least_size);

/// Splits the leaves that hold the places until they are no larger than asked, or `deepest`, or as
/// small as the field allows.
Grid split_to_sizes(Grid grid, std::span<const SizedPlace> places, int deepest,
                    const SizeField& sizes = {});

}  // namespace hexwright
