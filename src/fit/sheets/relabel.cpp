// Labels are collected by vertices before the state is rebuilt, and looked up after.
#include "fit/sheets/relabel.h"

#include <algorithm>

#include "mesh/quad.h"

namespace hexwright::fitting {

using namespace relax;

namespace {

class Relabeling {
 public:
  Relabeling(FitState& state, BoundaryState& boundary, const SheetPlan& plan,
             const std::vector<VertId>& copies)
      : state_(state), boundary_(boundary), plan_(plan), copies_(copies) {}

  void run() {
    copy_of_.assign(boundary_.graph.num_verts(), VertId{});
    for (std::size_t i = 0; i < copies_.size(); ++i) copy_of_[plan_.sheet.verts[i]] = copies_[i];
    std::vector<QuadLabel> labels = label_quads();
    label_rim(labels);
    const std::vector<LabeledEdge> edges = move_edges();
    state_.resize_arrays();
    for (std::size_t i = 0; i < copies_.size(); ++i) place_copy(i);
    state_.rebuild();
    boundary_.rebuild(state_, edges, std::move(labels));
  }

 private:
  bool follows(QuadId q) const { return plan_.follows[q.index()] != 0; }
  VertId moved(VertId v) const { return copy_of_[v].is_valid() ? copy_of_[v] : v; }
  CurvePlace curve_place(std::size_t i) const {
    return plan_.on_curve.empty() ? CurvePlace{} : plan_.on_curve[i];
  }

  std::vector<QuadLabel> label_quads() const {
    std::vector<QuadLabel> labels;
    for (QuadId q : boundary_.quad_to_region.ids()) {
      auto verts = state_.quads[q.index()];
      if (follows(q))
        for (VertId& v : verts) v = moved(v);
      labels.push_back({sorted(verts), boundary_.quad_to_region[q]});
    }
    return labels;
  }

  /// The sheet's own boundary quads stand on the edges between quads that follow and others.
  void label_rim(std::vector<QuadLabel>& labels) const {
    for (std::size_t i = 0; i < boundary_.graph.num_edges(); ++i) {
      const auto& edge = boundary_.graph.edge(BoundaryEdgeId(i));
      if (edge.num_quads != 2 || follows(edge.quads[0]) == follows(edge.quads[1])) continue;
      const QuadId follower = edge.quads[follows(edge.quads[0]) ? 0 : 1];
      labels.push_back({sorted({edge.a, edge.b, moved(edge.a), moved(edge.b)}),
                        boundary_.quad_to_region[follower]});
    }
  }

  std::vector<LabeledEdge> move_edges() const {
    std::vector<LabeledEdge> edges;
    for (BoundaryEdgeId e : boundary_.edge_to_curve.ids()) {
      if (!boundary_.is_marked(e)) continue;
      const auto& edge = boundary_.graph.edge(e);
      const bool moves = edge.num_quads == 2 && follows(edge.quads[0]) && follows(edge.quads[1]);
      edges.push_back({{edge.a, edge.b}, boundary_.edge_to_curve[e]});
      if (moves) edges.back().verts = {moved(edge.a), moved(edge.b)};
    }
    for (std::size_t i = 0; i < copies_.size(); ++i)
      if (const CurveId curve = curve_place(i).curve; curve.is_valid())
        edges.push_back({{plan_.sheet.verts[i], copies_[i]}, curve});
    return edges;
  }

  void place_copy(std::size_t i) {
    const VertId v = plan_.sheet.verts[i], w = copies_[i];
    QuadId follower;
    bool is_kept = false;  // by some quad of the boundary
    for (QuadId q : boundary_.graph.quads(v)) {
      if (follows(q))
        follower = q;
      else
        is_kept = true;
    }
    if (!follower.is_valid()) return;  // the copy is inside the mesh
    state_.target[w] = state_.target[v];
    state_.direction[w] = state_.direction[v];
    if (is_kept)
      place_on_rim(w, curve_place(i), follower);
    else
      take_place(v, w);
  }

  /// A copy on the rim is on the curve that it was planned on, or in the region that gave way.
  void place_on_rim(VertId w, const CurvePlace& place, QuadId follower) {
    if (place.curve.is_valid()) {
      state_.kind[w] = VertKind::Curve;
      state_.curve[w] = place.curve;
      state_.arc[w] = place.arc;
    } else {
      state_.kind[w] = VertKind::Surface;
      state_.patch[w] = boundary_.region_to_patch[boundary_.quad_to_region[follower]];
    }
  }

  void take_place(VertId v, VertId w) {
    state_.kind[w] = state_.kind[v];
    state_.patch[w] = state_.patch[v];
    state_.curve[w] = state_.curve[v];
    state_.arc[w] = state_.arc[v];
    state_.feature_point[w] = state_.feature_point[v];
    state_.kind[v] = VertKind::Interior;
  }

  FitState& state_;
  BoundaryState& boundary_;
  const SheetPlan& plan_;
  const std::vector<VertId>& copies_;  // per sheet vertex
  IdVector<VertId, VertId> copy_of_;   // invalid where the sheet does not pass
};

}  // namespace

Insertion apply_plan(FitState& state, BoundaryState& boundary, const SheetPlan& plan) {
  Insertion insertion = insert_sheet(state.mesh, state.vert_to_hex, plan);
  if (!insertion.copies.empty()) Relabeling(state, boundary, plan, insertion.copies).run();
  return insertion;
}

}  // namespace hexwright::fitting
