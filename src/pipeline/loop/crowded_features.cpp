// Samples of all curves in a tree; each missed place asks for those around it.
#include "pipeline/loop/crowded_features.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hexwright/grid/locate.h"

#include "geometry/tree/point_tree.h"
#include "pipeline/loop/feature_misses.h"

namespace hexwright {
namespace {

/// Two curves that leave a corner at an angle of less than about 20 degrees crowd each other.
constexpr double kCornerGaps = 3;
/// Gaps of less than this share of a cell are out of reach of the grid.
constexpr double kCrowded = 0.25;
/// Samples per least size: gaps between samples are too large by a few percent at most.
constexpr double kSamplesPerSize = 2;

struct CurveSamples {
  std::vector<Vec3> points;
  std::vector<CurveId> curves;
};

CurveSamples sample(const TriMesh& surface, const FeatureGraph& features, double step) {
  CurveSamples samples;
  for (CurveId c : features.curves.ids()) {
    const FeatureCurve& curve = features.curves[c];
    const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(curve.length() / step));
    for (std::size_t i = 0; i <= count; ++i) {
      const double arc = curve.length() * static_cast<double>(i) / static_cast<double>(count);
      samples.points.push_back(point_at_arc(surface, curve, arc).point);
      samples.curves.push_back(c);
    }
  }
  return samples;
}

/// Whether the curves meet at a corner not far beyond the gap between them.
bool meet_nearby(const TriMesh& surface, const FeatureCurve& a, const FeatureCurve& b,
                 const Vec3& p, double gap) {
  if (a.is_closed || b.is_closed) return false;
  for (VertId v : {a.verts.front(), a.verts.back()})
    for (VertId w : {b.verts.front(), b.verts.back()})
      if (v == w && distance(surface.positions[v], p) < kCornerGaps * gap) return true;
  return false;
}

class GapFinder {
 public:
  GapFinder(const TriMesh& surface, const FeatureGraph& features, double step)
      : surface_(surface),
        features_(features),
        samples_(sample(surface, features, step)),
        tree_(samples_.points) {}

  /// From p on a curve to the nearest other one, at most `reach`.
  double gap_at(const Vec3& p, CurveId on, double reach) const {
    const Vec3 r = {reach, reach, reach};
    double gap = reach;
    tree_.visit_box({p - r, p + r}, [&](std::size_t i) {
      const CurveId other = samples_.curves[i];
      if (other == on) return;
      const double d = distance(tree_.points()[i], p);
      if (d < gap && !meet_nearby(surface_, features_.curves[on], features_.curves[other], p, d))
        gap = d;
    });
    return gap;
  }

 private:
  const TriMesh& surface_;
  const FeatureGraph& features_;
  CurveSamples samples_;
  PointTree tree_;
};

}  // namespace

std::vector<SizedPlace> find_crowded_misses(const Grid& grid, const TriMesh& surface,
                                            const FeatureGraph& features,
                                            const FeatureRecovery& recovery, double least_size) {
  std::vector<SizedPlace> places;
  const GapFinder gaps(surface, features, least_size / kSamplesPerSize);
  for (const MissedFeature& miss : recovery.missed) {
    if (!miss.curve.is_valid() || recovery.curves[miss.curve].length_share >= kFollowedShare)
      continue;
    const CellId leaf = find_leaf_at(grid, miss.position);
    if (!leaf.is_valid()) continue;
    const double edge = cell_box(grid, leaf).extent().x;
    const double reach = kCrowded * edge;
    const double gap = gaps.gap_at(miss.position, miss.curve, reach);
    const double wanted = std::max(gap, least_size);
    if (gap < reach && wanted < edge) places.push_back({miss.position, wanted});
  }
  return places;
}

Grid split_to_sizes(Grid grid, std::span<const SizedPlace> places, int deepest,
                    const SizeField& sizes) {
  while (true) {
    std::vector<char> marks(grid.num_cells(), 0);
    bool any = false;
    for (const SizedPlace& place : places) {
      const CellId leaf = find_leaf_at(grid, place.position);
      if (!leaf.is_valid() || grid.cells[leaf].level >= deepest) continue;
      if (cell_box(grid, leaf).extent().x <= place.cell_size) continue;
      if (!sizes.empty() && !may_split(grid, leaf, sizes)) continue;
      marks[leaf.index()] = 1;
      any = true;
    }
    if (!any) return grid;
    grid = split_cells(grid, marks);
  }
}

}  // namespace hexwright
