// Crease edges, chained into curves between corners, without short stray pieces; and the patches
// between them.
#include "hexwright/geometry/feature_graph.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/geometry/exposure.h"

#include "geometry/features/edges_along.h"
#include "geometry/topology/surface_edges.h"
#include "geometry/tree/triangle_math.h"

namespace hexwright {
namespace {

/// Pruning one piece can leave another dangling, so it is repeated, but not so often that a long
/// curve with many twigs would be eaten from its end.
constexpr int kPruneRounds = 3;

/// Boundary and non-manifold edges are creases whatever their angle. Normals are compared as if
/// both triangles were oriented alike, so that flipped triangles make no crease.
bool is_crease(const std::span<const SurfaceEdges::Side> sides, const std::vector<Vec3>& normals,
               double min_cosine) {
  if (sides.size() != 2) return true;
  const Vec3& a = normals[sides[0].tri.index()];
  const Vec3& b = normals[sides[1].tri.index()];
  if (a == Vec3{} || b == Vec3{}) return false;  // a degenerate triangle has no angle
  const bool is_consistent = sides[0].is_forward != sides[1].is_forward;
  return (is_consistent ? dot(a, b) : -dot(a, b)) < min_cosine;
}

/// Whether triangles of different groups meet; those that were added to the surface have none.
bool is_group_border(const TriMesh& surface, const std::span<const SurfaceEdges::Side> sides) {
  if (surface.group.empty()) return false;
  std::int32_t first = -1;
  for (const auto& side : sides) {
    const std::int32_t group = surface.group[side.tri];
    if (group >= 0 && first >= 0 && group != first) return true;
    if (group >= 0) first = group;
  }
  return false;
}

/// Sorted, each edge once; the vertices are checked, as they come from files.
std::vector<std::uint64_t> user_keys(const TriMesh& surface,
                                     std::span<const std::array<VertId, 2>> user_edges) {
  std::vector<std::uint64_t> keys;
  for (const auto& [a, b] : user_edges) {
    for (VertId v : {a, b})
      if (!v.is_valid() || v.index() >= surface.num_verts())
        throw Error(ErrorCode::BadArgument,
                    "a feature edge uses vertex " + std::to_string(v.value()) +
                        ", but the surface has " + std::to_string(surface.num_verts()) +
                        " vertices; correct the list of feature edges");
    if (a != b) keys.push_back(edge_key(a, b));
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

/// From this share of the diagonal on needles along an edge are how a strip beside it is
/// triangulated, as on extruded profiles; along shorter ones they are slivers, whose normals make
/// creases of noise.
constexpr double kLongEdge = 0.03;

/// Whether some part of the edge, at a few points, lies on the boundary of the solid.
bool is_exposed(const SurfaceTree& tree, const SurfaceEdges& edges, std::size_t e) {
  const TriMesh& surface = tree.surface();
  const Vec3 a = surface.positions[edges.lo(e)], b = surface.positions[edges.hi(e)];
  const bool is_long = distance(a, b) > kLongEdge * tree.box().diagonal();
  for (double along : {0.5, 0.1, 0.9, 0.3, 0.7})
    for (const auto& side : edges.sides_of(e)) {
      const Vec3 p = a + (b - a) * along;
      if (bounds_solid(tree, side.tri, p)) return true;
      if (is_long && bounds_solid_closely(tree, side.tri, p)) return true;
    }
  return false;
}

/// Whether the solid is thinner, seen from a side of the curve, than the curve's piece is long: the
/// rim of a rod, a pin or a rib, which is no noise however short. Asked at a few edges.
bool is_around_thin(const SurfaceTree& tree, const SurfaceEdges& edges, const FeatureCurve& curve,
                    double length) {
  constexpr std::size_t kNumProbes = 6;
  const std::size_t num_edges = curve.verts.size() - 1;
  const std::size_t step = std::max<std::size_t>(1, num_edges / kNumProbes);
  for (std::size_t k = 0; k < num_edges; k += step) {
    const long e = edges.find(curve.verts[k], curve.verts[k + 1]);
    if (e < 0) return false;
    const auto sides = edges.sides_of(static_cast<std::size_t>(e));
    const bool is_thin = std::ranges::any_of(sides, [&](const SurfaceEdges::Side& side) {
      const auto c = tree.surface().corners(side.tri);
      const Vec3 center = (c[0] + c[1] + c[2]) / 3;
      return !tree.is_inside(center - tree.normal(side.tri) * length);
    });
    if (!is_thin) return false;
  }
  return true;
}

/// With a tree only the exposed ones.
std::vector<std::uint64_t> crease_keys(const TriMesh& surface, double angle,
                                       const SurfaceTree* tree) {
  std::vector<Vec3> normals(surface.num_tris());
  for (TriId t : surface.tris.ids()) normals[t.index()] = unit_normal(surface.corners(t));
  const SurfaceEdges edges = compute_surface_edges(surface);
  const double min_cosine = std::cos(angle);
  std::vector<char> is_taken(edges.size());
  constexpr std::size_t kGrain = 16;  // where needles crowd, one test takes a millisecond
  parallel_for(
      edges.size(),
      [&](std::size_t e) {
        is_taken[e] = (is_crease(edges.sides_of(e), normals, min_cosine) ||
                       is_group_border(surface, edges.sides_of(e))) &&
                      (!tree || is_exposed(*tree, edges, e));
      },
      kGrain);
  std::vector<std::uint64_t> keys;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (is_taken[e]) keys.push_back(edges.keys[e]);
  return keys;
}

/// Sorted, of edges in any order.
std::vector<std::uint64_t> keys_of(std::span<const std::array<VertId, 2>> edges) {
  std::vector<std::uint64_t> keys;
  for (const auto& [a, b] : edges) keys.push_back(edge_key(a, b));
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// The graph of crease edges, from which pieces are removed.
class CreaseGraph {
 public:
  CreaseGraph(const TriMesh& surface, const SurfaceTree* tree, const FeatureOptions& options,
              std::span<const std::array<VertId, 2>> user_edges,
              const std::vector<std::uint64_t>& creases)
      : surface_(surface),
        tree_(tree),
        min_turn_cosine_(std::cos(options.turn_angle)),
        min_length_(options.min_length),
        user_keys_(user_keys(surface, user_edges)),
        neighbors_(surface.num_verts()) {
    std::set_union(creases.begin(), creases.end(), user_keys_.begin(), user_keys_.end(),
                   std::back_inserter(keys_));
    for (std::uint64_t key : keys_) {
      const VertId a(key >> 32), b(key & 0xffffffffu);
      neighbors_[a].push_back(b);
      neighbors_[b].push_back(a);
    }
    for (auto& around : neighbors_) std::sort(around.begin(), around.end());
    is_used_.resize(keys_.size());
  }

  bool is_corner(VertId v) const {
    const auto& around = neighbors_[v];
    if (around.size() != 2) return !around.empty();
    const auto& x = surface_.positions;
    return dot(normalized(x[v] - x[around[0]]), normalized(x[around[1]] - x[v])) < min_turn_cosine_;
  }

  /// All chains between corners, then all loops; each edge is in exactly one.
  std::vector<FeatureCurve> chain() {
    std::fill(is_used_.begin(), is_used_.end(), char(0));
    std::vector<FeatureCurve> curves;
    for (VertId v : neighbors_.ids())
      if (is_corner(v))
        for (VertId next : neighbors_[v])
          if (!is_used_[edge_index(v, next)]) curves.push_back(walk(v, next, false));
    for (std::size_t e = 0; e < keys_.size(); ++e)
      if (!is_used_[e] && is_alive(e))
        curves.push_back(walk(VertId(keys_[e] >> 32), VertId(keys_[e] & 0xffffffffu), true));
    return curves;
  }

  /// Removes dangling chains and whole connected pieces that are shorter than the least length.
  bool prune(const std::vector<FeatureCurve>& curves) {
    const std::vector<double> piece_length = lengths_of_pieces(curves);
    std::vector<std::size_t> removed;
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const FeatureCurve& c = curves[i];
      const bool is_dangling = !c.is_closed && (neighbors_[c.verts.front()].size() == 1 ||
                                                neighbors_[c.verts.back()].size() == 1);
      const bool is_short =
          (is_dangling && c.length() < min_length_) || piece_length[i] < min_length_;
      if (is_short && !has_user_edge(c) && (is_dangling || !is_thin(c, piece_length[i])))
        removed.push_back(i);
    }
    for (std::size_t i : removed)
      for (std::size_t k = 1; k < curves[i].verts.size(); ++k)
        remove(curves[i].verts[k - 1], curves[i].verts[k]);
    return !removed.empty();
  }

 private:
  bool is_thin(const FeatureCurve& curve, double length) {
    if (!tree_) return false;
    if (!edges_) edges_ = compute_surface_edges(surface_);
    return is_around_thin(*tree_, *edges_, curve, length);
  }

  std::size_t edge_index(VertId a, VertId b) const {
    const auto it = std::lower_bound(keys_.begin(), keys_.end(), edge_key(a, b));
    return static_cast<std::size_t>(it - keys_.begin());
  }

  bool is_alive(std::size_t e) const {
    const auto& around = neighbors_[VertId(keys_[e] >> 32)];
    return std::binary_search(around.begin(), around.end(), VertId(keys_[e] & 0xffffffffu));
  }

  bool has_user_edge(const FeatureCurve& c) const {
    for (std::size_t k = 1; k < c.verts.size(); ++k)
      if (std::binary_search(user_keys_.begin(), user_keys_.end(),
                             edge_key(c.verts[k - 1], c.verts[k])))
        return true;
    return false;
  }

  void remove(VertId a, VertId b) {
    std::erase(neighbors_[a], b);
    std::erase(neighbors_[b], a);
  }

  /// From `start` over `next` until a corner or `start` comes; edges on the way are marked as used.
  /// Away from corners a vertex has exactly two edges, so the way on is never in doubt.
  FeatureCurve walk(VertId start, VertId next, bool is_closed) {
    FeatureCurve curve;
    curve.is_closed = is_closed;
    curve.verts = {start, next};
    is_used_[edge_index(start, next)] = 1;
    while (!is_corner(curve.verts.back()) && curve.verts.back() != start) {
      const VertId here = curve.verts.back(), from = curve.verts[curve.verts.size() - 2];
      const auto& around = neighbors_[here];
      const VertId to = around[0] == from ? around[1] : around[0];
      is_used_[edge_index(here, to)] = 1;
      curve.verts.push_back(to);
    }
    curve.arc_length = {0};
    for (std::size_t i = 1; i < curve.verts.size(); ++i)
      curve.arc_length.push_back(
          curve.arc_length.back() +
          distance(surface_.positions[curve.verts[i - 1]], surface_.positions[curve.verts[i]]));
    return curve;
  }

  /// For each curve the length of all curves connected to it.
  std::vector<double> lengths_of_pieces(const std::vector<FeatureCurve>& curves) const {
    IdVector<VertId, int> first_at(surface_.num_verts(), -1);
    UnionFind pieces(curves.size());
    for (std::size_t i = 0; i < curves.size(); ++i)
      for (VertId v : {curves[i].verts.front(), curves[i].verts.back()}) {
        if (first_at[v] < 0) first_at[v] = static_cast<int>(i);
        pieces.unite(first_at[v], static_cast<int>(i));
      }
    std::vector<double> sum(curves.size(), 0), length(curves.size());
    const auto root = [&](std::size_t i) {
      return static_cast<std::size_t>(pieces.find(static_cast<int>(i)));
    };
    for (std::size_t i = 0; i < curves.size(); ++i) sum[root(i)] += curves[i].length();
    for (std::size_t i = 0; i < curves.size(); ++i) length[i] = sum[root(i)];
    return length;
  }

  const TriMesh& surface_;
  const SurfaceTree* tree_;            // absent: nothing is known of the solid
  std::optional<SurfaceEdges> edges_;  // made when first asked for
  double min_turn_cosine_, min_length_;
  std::vector<std::uint64_t> user_keys_;  // sorted
  std::vector<std::uint64_t> keys_;       // sorted; all crease edges, removed ones too
  IdVector<VertId, std::vector<VertId>> neighbors_;
  std::vector<char> is_used_;  // per key, while chaining
};

/// Chains are made anew after pruning: what a twig cut in two becomes one curve again.
FeatureGraph extract(const TriMesh& surface, const SurfaceTree* tree, const FeatureOptions& options,
                     const std::vector<std::uint64_t>& creases) {
  EdgesAlong user = find_edges_along(surface, options.extra_segments);
  user.edges.insert(user.edges.end(), options.extra_edges.begin(), options.extra_edges.end());
  CreaseGraph graph(surface, tree, options, user.edges, creases);
  auto curves = graph.chain();
  for (int round = 0; round < kPruneRounds && graph.prune(curves); ++round) curves = graph.chain();
  FeatureGraph features;
  features.num_unmatched_segments = user.num_unmatched;
  features.curves = IdVector<CurveId, FeatureCurve>(std::move(curves));
  for (const FeatureCurve& c : features.curves)
    if (!c.is_closed)
      features.corners.insert(features.corners.end(), {c.verts.front(), c.verts.back()});
  auto& corners = features.corners;
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return features;
}

}  // namespace

double FeatureGraph::total_length() const {
  double sum = 0;
  for (const FeatureCurve& c : curves) sum += c.length();
  return sum;
}

std::vector<std::array<VertId, 2>> find_creases(const SurfaceTree& surface, double crease_angle) {
  std::vector<std::array<VertId, 2>> creases;
  for (std::uint64_t key : crease_keys(surface.surface(), crease_angle, &surface))
    creases.push_back({VertId(key >> 32), VertId(key & 0xffffffffu)});
  return creases;
}

FeatureGraph extract_features(const TriMesh& surface, const FeatureOptions& options) {
  return extract(surface, nullptr, options, crease_keys(surface, options.crease_angle, nullptr));
}

FeatureGraph extract_features(const SurfaceTree& surface, const FeatureOptions& options) {
  const TriMesh& mesh = surface.surface();
  return extract(mesh, &surface, options, crease_keys(mesh, options.crease_angle, &surface));
}

FeatureGraph extract_features(const SurfaceTree& surface, const FeatureOptions& options,
                              std::span<const std::array<VertId, 2>> creases) {
  return extract(surface.surface(), &surface, options, keys_of(creases));
}

IdVector<TriId, PatchId> compute_patches(const TriMesh& surface, const FeatureGraph& features,
                                         std::span<const char> is_barrier) {
  std::vector<std::uint64_t> barriers;
  for (CurveId c : features.curves.ids()) {
    if (!is_barrier.empty() && !is_barrier[c.index()]) continue;
    const auto& verts = features.curves[c].verts;
    for (std::size_t i = 1; i < verts.size(); ++i)
      barriers.push_back(edge_key(verts[i - 1], verts[i]));
  }
  std::sort(barriers.begin(), barriers.end());
  const SurfaceEdges edges = compute_surface_edges(surface);
  UnionFind sets(surface.num_tris());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges.sides_of(e);
    if (sides.size() < 2 || std::binary_search(barriers.begin(), barriers.end(), edges.keys[e]))
      continue;
    for (std::size_t i = 1; i < sides.size(); ++i)
      sets.unite(sides[0].tri.value(), sides[i].tri.value());
  }
  IdVector<TriId, PatchId> patches;
  for (int number : number_sets(sets, surface.num_tris())) patches.push_back(PatchId(number));
  return patches;
}

}  // namespace hexwright
