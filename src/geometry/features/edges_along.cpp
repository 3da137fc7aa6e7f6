// Walks from one end of a segment to the other over vertices that lie on it.
#include "geometry/features/edges_along.h"

#include <algorithm>

#include "geometry/topology/surface_edges.h"
#include "geometry/tree/point_tree.h"

namespace hexwright {
namespace {

/// Files round coordinates to five or six digits; vertices of a sensible surface are farther apart.
constexpr double kTolRelDiagonal = 1e-5;

class EdgeWalker {
 public:
  explicit EdgeWalker(const TriMesh& surface)
      : surface_(surface),
        tolerance_(kTolRelDiagonal * bounding_box(surface).diagonal()),
        tree_(surface.positions.raw()),
        neighbors_(surface.num_verts()) {
    const SurfaceEdges edges = compute_surface_edges(surface);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      neighbors_[edges.lo(e)].push_back(edges.hi(e));
      neighbors_[edges.hi(e)].push_back(edges.lo(e));
    }
  }

  /// The chain of vertices from a to b; empty when there is none.
  std::vector<VertId> walk(const Vec3& a, const Vec3& b) const {
    std::vector<VertId> chain;
    tree_.visit_box({a - reach(), a + reach()}, [&](std::size_t start) {
      if (chain.empty() && !neighbors_[VertId(start)].empty()) chain = walk_from(VertId(start), b);
    });
    return chain;
  }

 private:
  Vec3 reach() const { return {tolerance_, tolerance_, tolerance_}; }

  std::vector<VertId> walk_from(VertId start, const Vec3& b) const {
    std::vector<VertId> chain = {start};
    const auto& x = surface_.positions;
    while (distance(x[chain.back()], b) > tolerance_) {
      const VertId next = step_towards(chain.back(), b);
      if (!next.is_valid()) return {};
      chain.push_back(next);
    }
    return chain.size() > 1 ? chain : std::vector<VertId>{};
  }

  /// The nearest neighbour that lies on the way from v to b; each step shortens the way.
  /// Progress by more than the tolerance in every step makes the walk end, on whatever surface.
  VertId step_towards(VertId v, const Vec3& b) const {
    const auto& x = surface_.positions;
    const double way = distance(x[v], b);
    const Vec3 along = (b - x[v]) / way;
    VertId best;
    double least = way + tolerance_;
    for (VertId w : neighbors_[v]) {
      const Vec3 step = x[w] - x[v];
      const double progress = dot(step, along);
      if (progress <= tolerance_ || norm(step - along * progress) > tolerance_) continue;
      if (progress > least || (progress == least && best.is_valid() && best < w)) continue;
      least = progress;
      best = w;
    }
    return best;
  }

  const TriMesh& surface_;
  double tolerance_;
  PointTree tree_;
  IdVector<VertId, std::vector<VertId>> neighbors_;
};

}  // namespace

EdgesAlong find_edges_along(const TriMesh& surface, std::span<const std::array<Vec3, 2>> segments) {
  EdgesAlong result;
  if (segments.empty()) return result;
  const EdgeWalker walker(surface);
  for (const auto& [a, b] : segments) {
    const std::vector<VertId> chain = walker.walk(a, b);
    result.num_unmatched += chain.empty();
    for (std::size_t i = 1; i < chain.size(); ++i) result.edges.push_back({chain[i - 1], chain[i]});
  }
  return result;
}

}  // namespace hexwright
