// Groups of regions by curve convexity and corner feasibility; needs by hexes around edges.
#include "fit/sheets/groups.h"

#include <algorithm>

#include "fit/sheets/quad_fans.h"
#include "geometry/topology/surface_edges.h"

namespace hexwright::fitting {

using namespace relax;
namespace {

constexpr double kConvexShare = 0.9;  // of a curve's length, from which sheets may end on it

class GroupFinder {
 public:
  GroupFinder(const FitState& state, const BoundaryState& boundary,
              const IdVector<CurveId, double>& convex_share)
      : state_(state),
        boundary_(boundary),
        convex_share_(convex_share),
        sets_(boundary.region_to_patch.size()) {}

  PaddingGroups run() {
    unite_across_curves();
    while (unite_where_infeasible()) continue;
    number_groups();
    const auto needs = find_padding_needs(state_, boundary_, convex_share_, groups_);
    for (const PaddingNeed& need : needs) ++groups_.num_needs[need.group];
    return std::move(groups_);
  }

 private:
  int root(QuadId q) { return sets_.find(boundary_.quad_to_region[q].value()); }

  void unite_across_curves() {
    for (BoundaryEdgeId e : boundary_.edge_to_curve.ids()) {
      const auto& edge = boundary_.graph.edge(e);
      if (!boundary_.is_marked(e) || edge.num_quads != 2) continue;
      if (convex_share_[boundary_.edge_to_curve[e]] < kConvexShare)
        sets_.unite(root(edge.quads[0]), root(edge.quads[1]));
    }
  }

  /// A sheet's rim passes a vertex only if the group and the others each form one fan and at most
  /// one marked edge leaves to the others' side, from a corner. One union per vertex and pass.
  bool unite_where_infeasible() {
    bool any = false;
    for (VertId v : boundary_.graph.verts()) {
      std::vector<int> roots;
      for (QuadId q : boundary_.graph.quads(v)) roots.push_back(root(q));
      std::sort(roots.begin(), roots.end());
      roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
      if (roots.size() < 2) continue;
      for (int r : roots) {
        const QuadFans fans = find_quad_fans(boundary_, v, [&](QuadId q) { return root(q) == r; });
        const auto num_marked = fans.marked_outside.size();
        const bool is_feasible = fans.num_inside == 1 && fans.num_outside == 1 && num_marked <= 1 &&
                                 (num_marked == 0 || state_.kind[v] == VertKind::Corner);
        if (is_feasible) continue;
        sets_.unite(r, roots[0] == r ? roots[1] : roots[0]);
        any = true;
        break;
      }
    }
    return any;
  }

  void number_groups() {
    const auto numbers = number_sets(sets_, boundary_.region_to_patch.size());
    std::size_t count = 0;
    for (int n : numbers) {
      groups_.region_to_group.push_back(GroupId(n));
      count = std::max(count, static_cast<std::size_t>(n) + 1);
    }
    groups_.num_quads.assign(count, 0);
    groups_.num_needs.assign(count, 0);
    for (QuadId q : boundary_.quad_to_region.ids())
      ++groups_.num_quads[groups_.region_to_group[boundary_.quad_to_region[q]]];
  }

  const FitState& state_;
  const BoundaryState& boundary_;
  const IdVector<CurveId, double>& convex_share_;
  UnionFind sets_;
  PaddingGroups groups_;
};

class NeedFinder {
 public:
  NeedFinder(const FitState& state, const BoundaryState& boundary,
             const IdVector<CurveId, double>& convex_share, const PaddingGroups& groups)
      : state_(state), boundary_(boundary), convex_share_(convex_share), groups_(groups) {}

  std::vector<PaddingNeed> run() {
    find_edge_needs();
    find_squeeze_needs();
    std::stable_sort(needs_.begin(), needs_.end(),
                     [](const PaddingNeed& x, const PaddingNeed& y) { return x.group < y.group; });
    return std::move(needs_);
  }

 private:
  GroupId group(QuadId q) const { return groups_.region_to_group[boundary_.quad_to_region[q]]; }

  /// Hexes of the kept side around each boundary edge.
  IdVector<BoundaryEdgeId, int> count_hexes_around() const {
    IdVector<BoundaryEdgeId, int> count(boundary_.graph.num_edges(), 0);
    for (HexId h : state_.mesh.hexes.ids())
      for (const auto& le : kHexEdges) {
        const auto& hex = state_.mesh.hexes[h];
        const VertId a = hex[static_cast<std::size_t>(le[0])];
        const VertId b = hex[static_cast<std::size_t>(le[1])];
        if (!state_.is_boundary(a) || !state_.is_boundary(b)) continue;
        const BoundaryEdgeId e = boundary_.graph.find_edge(a, b);
        if (e.is_valid()) ++count[e];
      }
    return count;
  }

  /// An edge inside a smooth part with one hex around it; a concave edge with one; a convex edge
  /// with three or more, which a sheet on either side mends: the smaller side gets it.
  void find_edge_needs() {
    const auto num_hexes = count_hexes_around();
    for (BoundaryEdgeId e : num_hexes.ids()) {
      const auto& edge = boundary_.graph.edge(e);
      if (edge.num_quads != 2) continue;
      const GroupId a = group(edge.quads[0]), b = group(edge.quads[1]);
      if (!boundary_.is_marked(e)) {
        if (num_hexes[e] == 1) needs_.push_back({a, edge.a, edge.b});
      } else if (convex_share_[boundary_.edge_to_curve[e]] < 0.5) {
        if (num_hexes[e] != 1) continue;
        needs_.push_back({a, edge.a, edge.b, true});
        if (b != a) needs_.push_back({b, edge.a, edge.b, true});
      } else if (num_hexes[e] >= 3) {
        const GroupId smaller = groups_.num_quads[a] < groups_.num_quads[b] ? a : b;
        needs_.push_back({smaller, edge.a, edge.b});
      }
    }
  }

  /// A quad squeezed at a curve vertex is mended by the sheet of the group across the curve.
  void find_squeeze_needs() {
    for (QuadId q : boundary_.quad_to_region.ids()) {
      const auto& edges = boundary_.graph.quad_edges(q);
      for (std::size_t k = 0; k < 4; ++k) {
        const BoundaryEdgeId e0 = edges[k], e1 = edges[(k + 3) % 4];
        if (state_.kind[state_.quads[q.index()][k]] != VertKind::Curve) continue;
        if (!boundary_.is_marked(e0) || !boundary_.is_marked(e1)) continue;
        for (BoundaryEdgeId e : {e0, e1}) {
          if (boundary_.graph.edge(e).num_quads != 2) continue;
          const GroupId other = group(boundary_.graph.edge(e).other(q));
          if (other != group(q)) needs_.push_back({other, state_.quads[q.index()][k], {}});
        }
      }
    }
  }

  const FitState& state_;
  const BoundaryState& boundary_;
  const IdVector<CurveId, double>& convex_share_;
  const PaddingGroups& groups_;
  std::vector<PaddingNeed> needs_;
};

}  // namespace

PaddingGroups find_padding_groups(const FitState& state, const BoundaryState& boundary,
                                  const IdVector<CurveId, double>& convex_share) {
  return GroupFinder(state, boundary, convex_share).run();
}

std::vector<PaddingNeed> find_padding_needs(const FitState& state, const BoundaryState& boundary,
                                            const IdVector<CurveId, double>& convex_share,
                                            const PaddingGroups& groups) {
  return NeedFinder(state, boundary, convex_share, groups).run();
}

}  // namespace hexwright::fitting
