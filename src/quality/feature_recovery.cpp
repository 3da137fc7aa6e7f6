// How much of a surface's feature curves and corners a hex mesh represents.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

#include "hexwright/base/parallel.h"
#include "hexwright/quality/judge.h"

#include "geometry/tree/point_tree.h"

namespace hexwright {
namespace {

// A mesh edge runs along a curve when their directions differ by 30 degrees at most: a polygon of
// six sides still follows a circle, while edges that only cross the curve do not count.
constexpr double kMinCosine = 0.86602540378443864;

// Midpoints of equal pieces of the curves.
struct CurveSamples {
  std::vector<Vec3> points;
  std::vector<Vec3> tangents;
  std::vector<double> lengths;  // of the piece each sample stands for
  std::vector<CurveId> curves;
};

CurveSamples sample_curves(const TriMesh& surface, const FeatureGraph& features, double step) {
  CurveSamples samples;
  for (CurveId c : features.curves.ids()) {
    const FeatureCurve& curve = features.curves[c];
    const double length = curve.length();
    if (!(length > 0)) continue;
    const auto count = static_cast<std::size_t>(std::ceil(length / step));
    const double piece = length / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
      const CurvePoint p = point_at_arc(surface, curve, (static_cast<double>(i) + 0.5) * piece);
      samples.points.push_back(p.point);
      samples.tangents.push_back(p.tangent);
      samples.lengths.push_back(piece);
      samples.curves.push_back(c);
    }
  }
  return samples;
}

double total_turn(const TriMesh& surface, const FeatureCurve& curve) {
  double turn = 0;
  const auto direction = [&](std::size_t i) {
    return normalized(surface.positions[curve.verts[i]] - surface.positions[curve.verts[i - 1]]);
  };
  for (std::size_t i = 2; i < curve.verts.size(); ++i)
    turn += std::acos(std::clamp(dot(direction(i - 1), direction(i)), -1.0, 1.0));
  return turn;
}

using Edge = std::array<VertId, 2>;

/// Each edge once, lower vertex first.
std::vector<Edge> collect_edges(const std::vector<std::array<VertId, 4>>& quads) {
  std::vector<Edge> edges;
  edges.reserve(4 * quads.size());
  for (const auto& quad : quads)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto [first, second] = std::minmax(quad[k], quad[(k + 1) % 4]);
      edges.push_back({first, second});
    }
  parallel_stable_sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

using Segment = std::array<Vec3, 2>;

/// Edges as segments; those of second order as several.
std::vector<Segment> to_segments(const HexMesh& mesh, const std::vector<Edge>& edges) {
  constexpr int kDivisions = 8;
  std::vector<Segment> segments;
  segments.reserve(edges.size());
  std::optional<EdgeTable> table;
  if (mesh.mid_nodes) table.emplace(mesh);
  for (const auto& [first, last] : edges) {
    const Vec3 &a = mesh.positions[first], &b = mesh.positions[last];
    const EdgeId edge = table ? table->find(first, last) : EdgeId();
    const Vec3 offset = edge.is_valid() ? mesh.mid_nodes->edges[edge] - 0.5 * (a + b) : Vec3{};
    if (norm_sq(offset) == 0) {
      segments.push_back({a, b});
      continue;
    }
    const auto at = [&](int i) {
      const double t = double(i) / kDivisions;
      return a + t * (b - a) + 4 * t * (1 - t) * offset;
    };
    for (int i = 0; i < kDivisions; ++i) segments.push_back({at(i), at(i + 1)});
  }
  return segments;
}

double distance_sq_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double length_sq = norm_sq(b - a);
  const double t = length_sq > 0 ? std::clamp(dot(p - a, b - a) / length_sq, 0.0, 1.0) : 0;
  return norm_sq(p - (a + t * (b - a)));
}

Box3 inflated_box(const Vec3& a, const Vec3& b, double margin) {
  const Vec3 m = {margin, margin, margin};
  return {min(a, b) - m, max(a, b) + m};
}

// Per sample: 1 when an edge runs along it within the tolerance.
std::vector<char> find_recovered(const std::vector<Segment>& edges, const CurveSamples& samples,
                                 double tolerance) {
  const PointTree tree(samples.points);
  std::vector<char> is_recovered(samples.points.size(), 0);
  parallel_for(
      edges.size(),
      [&](std::size_t e) {
        const Vec3 &a = edges[e][0], &b = edges[e][1];
        const Vec3 direction = normalized(b - a);
        tree.visit_box(inflated_box(a, b, tolerance), [&](std::size_t i) {
          if (std::abs(dot(direction, samples.tangents[i])) >= kMinCosine &&
              distance_sq_to_segment(samples.points[i], a, b) <= tolerance * tolerance)
            std::atomic_ref(is_recovered[i]).store(1, std::memory_order_relaxed);
        });
      },
      256);
  return is_recovered;
}

// Every vertex of the edges once.
std::vector<Vec3> collect_points(const HexMesh& mesh, const std::vector<Edge>& edges) {
  std::vector<VertId> verts;
  for (const Edge& edge : edges) verts.insert(verts.end(), edge.begin(), edge.end());
  std::sort(verts.begin(), verts.end());
  verts.erase(std::unique(verts.begin(), verts.end()), verts.end());
  std::vector<Vec3> points;
  for (VertId v : verts) points.push_back(mesh.positions[v]);
  return points;
}

// Corners farther than the tolerance from every point, with the distance to the nearest.
std::vector<MissedFeature> find_missed_corners(const std::vector<Vec3>& points,
                                               const std::vector<Vec3>& corners, double tolerance) {
  const PointTree tree(points);
  std::vector<MissedFeature> missed;
  for (const Vec3& corner : corners) {
    bool is_near = false;
    tree.visit_box(inflated_box(corner, corner, tolerance), [&](std::size_t i) {
      is_near = is_near || norm_sq(tree.points()[i] - corner) <= tolerance * tolerance;
    });
    if (is_near) continue;
    double nearest_sq = std::numeric_limits<double>::infinity();  // few corners are missed
    for (const Vec3& p : points) nearest_sq = std::min(nearest_sq, norm_sq(p - corner));
    missed.push_back({corner, {}, std::sqrt(nearest_sq)});
  }
  return missed;
}

// Shares of the length, of all curves and of each; the samples without an edge become misses.
void add_up(const CurveSamples& samples, const std::vector<char>& is_recovered,
            FeatureRecovery& result) {
  IdVector<CurveId, double> recovered(result.curves.size(), 0.0);
  double length = 0;
  for (std::size_t i = 0; i < is_recovered.size(); ++i) {
    if (!is_recovered[i]) {
      result.missed.push_back({samples.points[i], samples.curves[i], 0});
      continue;
    }
    length += samples.lengths[i];
    recovered[samples.curves[i]] += samples.lengths[i];
  }
  result.length_share = std::min(1.0, length / result.total_length);
  for (CurveId c : recovered.ids()) {
    CurveRecovery& curve = result.curves[c];
    if (curve.length > 0) curve.length_share = std::min(1.0, recovered[c] / curve.length);
  }
}

}  // namespace

void FeatureRecovery::to_world(const Similarity& frame) {
  total_length = frame.length_to_world(total_length);
  for (CurveRecovery& curve : curves) curve.to_world(frame);
  for (MissedFeature& miss : missed) miss.to_world(frame);
}

FeatureRecovery measure_features(const HexMesh& mesh, const SurfaceTree& tree,
                                 const FeatureGraph& features, const JudgeOptions& options) {
  const TriMesh& surface = tree.surface();
  FeatureRecovery result;
  result.total_length = features.total_length();
  result.num_corners = features.corners.size();
  for (const FeatureCurve& curve : features.curves)
    result.curves.push_back({curve.length(), total_turn(surface, curve), 1});
  if (features.empty()) return result;
  const double diagonal = tree.diagonal();
  const auto edges = collect_edges(collect_judged_quads(mesh, options.quads));
  if (result.total_length > 0) {
    const double tolerance = options.edge_tolerance * diagonal;
    const CurveSamples samples = sample_curves(surface, features, tolerance);
    add_up(samples, find_recovered(to_segments(mesh, edges), samples, tolerance), result);
  }
  std::vector<Vec3> corners;
  for (VertId v : features.corners) corners.push_back(surface.positions[v]);
  const auto missed = find_missed_corners(collect_points(mesh, edges), corners,
                                          options.corner_tolerance * diagonal);
  result.num_corners_recovered = corners.size() - missed.size();
  result.missed.insert(result.missed.end(), missed.begin(), missed.end());
  return result;
}

}  // namespace hexwright
