// Corners, tubes, routing, then the paths' finish: no detours around a quad, monotone parameters.
#include "fit/curves/map_features.h"

#include <algorithm>
#include <cmath>

#include "hexwright/base/parallel.h"

#include "fit/curves/ban_short_curves.h"
#include "fit/curves/curve_convexity.h"
#include "fit/curves/curve_router.h"

namespace hexwright::fitting {

using namespace relax;
namespace {

constexpr double kMinSpacing = 0.2;  // of the mean spacing, between consecutive parameters
constexpr int kSmoothings = 3;
constexpr std::size_t kShortestShortened = 6;      // vertices a path must have to lose a detour
constexpr std::size_t kShortestShortenedLoop = 8;  // so that a loop stays a loop

/// Three edges of one quad become the fourth: a detour leaves a quad with only one free edge.
std::size_t remove_chords(const CurveRouter& router, const BoundaryGraph& graph, CurveId c,
                          bool is_loop, std::vector<VertId>& path) {
  std::size_t num_removed = 0;
  const std::size_t shortest = is_loop ? kShortestShortenedLoop : kShortestShortened;
  for (std::size_t i = 0; i + 3 < path.size();) {
    const bool is_chord = path.size() >= shortest && path[i] != path[i + 3] &&
                          !router.is_corner(path[i + 1]) && !router.is_corner(path[i + 2]) &&
                          graph.find_edge(path[i], path[i + 3]).is_valid() &&
                          !router.is_taken_edge(path[i], path[i + 3], c);
    if (!is_chord) {
      ++i;
      continue;
    }
    const auto first = path.begin() + static_cast<std::ptrdiff_t>(i);
    path.erase(first + 1, first + 3);
    ++num_removed;
    i = i >= 3 ? i - 3 : 0;  // the new edge may close another detour
  }
  return num_removed;
}

/// Closest arcs of a path's vertices, unwrapped along a loop, with the ends pinned.
std::vector<double> raw_arcs(const TriMesh& surface, const FeatureCurve& curve,
                             const BoundaryQuads& boundary, const std::vector<VertId>& path) {
  const double length = curve.length();
  const bool wraps = curve.is_closed || curve.verts.front() == curve.verts.back();
  std::vector<double> arcs(path.size(), 0.0);
  const auto closest = [&](VertId v) {
    return closest_on_curve(surface, curve, boundary.positions[v]).arc;
  };
  if (curve.is_closed) arcs[0] = closest(path[0]);
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    arcs[i] = closest(path[i]);
    if (wraps) arcs[i] -= length * std::round((arcs[i] - arcs[i - 1]) / length);
  }
  arcs.back() = arcs[0] + length;
  return arcs;
}

/// The average of the least ascending sequence above and the greatest below, then smoothed. Not
/// arc-length proportional: vertices stay near their closest points.
void make_monotone(std::vector<double>& arcs) {
  const std::size_t n = arcs.size();
  const double lo = arcs.front(), hi = arcs.back();
  const double spacing = kMinSpacing * (hi - lo) / static_cast<double>(n - 1);
  std::vector<double> forward = arcs, backward = arcs;
  for (std::size_t i = 1; i < n; ++i) forward[i] = std::max(forward[i], forward[i - 1] + spacing);
  for (std::size_t i = n - 1; i-- > 0;)
    backward[i] = std::min(backward[i], backward[i + 1] - spacing);
  for (std::size_t i = 1; i + 1 < n; ++i)
    arcs[i] = std::clamp(0.5 * (forward[i] + backward[i]), lo, hi);
  for (int k = 0; k < kSmoothings; ++k) {
    const auto old = arcs;
    for (std::size_t i = 1; i + 1 < n; ++i)
      arcs[i] = 0.25 * old[i - 1] + 0.5 * old[i] + 0.25 * old[i + 1];
  }
}

/// How far from its curve, in edge lengths, the mesh may be where the surface forms a wedge: hexes
/// filled by less than half are carved, so a wedge's tip is missing up to where it is an edge
/// length thick, and rounding to whole hexes takes another.
double wedge_reach(double angle, double most) {
  return std::min(most, 1 + 0.5 / std::tan(0.5 * std::max(angle, 1e-3)));
}

/// Per curve.
IdVector<CurveId, double> find_wedge_reaches(const TriMesh& surface, const FeatureGraph& features,
                                             double most) {
  IdVector<CurveId, double> reaches = compute_wedge_angles(surface, features);
  for (double& reach : reaches) reach = wedge_reach(reach, most);
  return reaches;
}

/// Per corner: that of its sharpest curve.
std::vector<double> find_corner_reaches(const FeatureGraph& features, const CornerEnds& ends,
                                        const IdVector<CurveId, double>& of_curves, double least) {
  std::vector<double> reaches(features.corners.size(), least);
  for (CurveId c : of_curves.ids())
    for (int corner : ends.curve_to_corners[c]) {
      if (corner < 0) continue;
      double& reach = reaches[static_cast<std::size_t>(corner)];
      reach = std::max(reach, of_curves[c]);
    }
  return reaches;
}

IdVector<CurveId, std::vector<TubeVert>> compute_tubes(const BoundaryQuads& boundary,
                                                       const VertReach& tree,
                                                       const TriMesh& surface,
                                                       const FeatureGraph& features,
                                                       const FeatureMapOptions& options,
                                                       const IdVector<CurveId, double>& wedge) {
  IdVector<CurveId, std::vector<TubeVert>> tubes(features.curves.size());
  parallel_for(
      tubes.size(),
      [&](std::size_t i) {
        const CurveId c(i);
        if (options.is_banned.empty() || !options.is_banned[c])
          tubes[c] = compute_tube(boundary, tree, surface, features.curves[c],
                                  std::max(options.tube_reach, wedge[c]));
      },
      1);
  return tubes;
}

/// Takes the routes over, and the corners where at least one of them ends.
FeatureMapping finish(const CurveRouter& router, const RoutingProblem& in) {
  FeatureMapping mapping;
  mapping.num_iterations = router.num_iterations();
  mapping.curves.resize(in.features.curves.size());
  mapping.corner_verts.resize(in.features.corners.size());
  for (CurveId c : in.features.curves.ids()) {
    const FeatureCurve& curve = in.features.curves[c];
    CurvePath& path = mapping.curves[c];
    path.reason = router.reason(c);
    path.verts = router.path(c);
    if (!path.is_mapped()) continue;
    path.reason.clear();
    const bool is_loop = path.verts.front() == path.verts.back();
    mapping.num_chords += remove_chords(router, in.graph, c, is_loop, path.verts);
    path.arcs = raw_arcs(in.surface, curve, in.boundary, path.verts);
    make_monotone(path.arcs);
    for (int corner : in.ends.curve_to_corners[c])
      if (corner >= 0) {
        const auto k = static_cast<std::size_t>(corner);
        mapping.corner_verts[k] = router.corner_verts()[k];
      }
  }
  return mapping;
}

}  // namespace

FeatureMapping map_features(const BoundaryQuads& boundary, const TriMesh& surface,
                            const FeatureGraph& features, const FeatureMapOptions& options) {
  const BoundaryGraph graph(boundary.positions.size(), boundary.quads);
  const auto wedge = find_wedge_reaches(surface, features, options.max_wedge_reach);
  double farthest = std::max(options.tube_reach, options.corner_reach);
  for (double reach : wedge) farthest = std::max(farthest, reach);
  const VertReach tree(boundary, graph.verts(), farthest);
  const auto tubes = compute_tubes(boundary, tree, surface, features, options, wedge);
  FeatureMapOptions narrowed = options;
  narrowed.is_banned.resize(features.curves.size(), 0);
  const auto is_short =
      ban_short_curves(boundary, features, tubes, options.min_edges, narrowed.is_banned);
  const CornerEnds ends = find_corner_ends(features, narrowed.is_banned);
  const RoutingProblem problem{boundary, graph, surface, features, ends, tubes, narrowed};
  CurveRouter router(
      problem, match_corners(boundary, graph, tree, surface, features, ends,
                             find_corner_reaches(features, ends, wedge, options.corner_reach)));
  router.run();
  FeatureMapping mapping = finish(router, problem);
  for (CurveId c : is_short.ids())
    if (is_short[c]) mapping.curves[c].reason = "shorter than the mesh resolves";
  return mapping;
}

}  // namespace hexwright::fitting
