// Compares leaves with the curves that pass them.
#include "pipeline/loop/feature_misses.h"

#include <algorithm>
#include <cmath>

#include "hexwright/grid/locate.h"

namespace hexwright {

/// A chord of length c departs from a circle of radius r by c^2 / 8r.
double sufficient_cell_size(const CurveRecovery& curve, double tolerance) {
  const double by_length = std::max(curve.length / kCellsPerCurve, kLeastFeatureCell * tolerance);
  if (!(curve.turn > 0)) return by_length;
  const double radius = curve.length / curve.turn;
  return std::min(by_length, std::sqrt(8 * radius * tolerance));
}

std::vector<Vec3> find_refinable_features(const Grid& grid, const FeatureRecovery& features,
                                          double tolerance, int deepest) {
  std::vector<Vec3> points;
  for (const MissedFeature& miss : features.missed) {
    const CellId leaf = find_leaf_at(grid, miss.position);
    if (!leaf.is_valid() || grid.cells[leaf].level >= deepest) continue;
    if (miss.curve.is_valid()) {
      const CurveRecovery& curve = features.curves[miss.curve];
      if (curve.length_share < kFollowedShare &&
          cell_box(grid, leaf).extent().x <= sufficient_cell_size(curve, tolerance))
        continue;
    }
    points.push_back(miss.position);
  }
  return points;
}

}  // namespace hexwright
