// Squeezed quads, and the bookkeeping of a sheet behind a set of hexes.
#include "fit/sheets/feature_layers.h"

#include <algorithm>
#include <cmath>

namespace hexwright::fitting {

using namespace relax;
namespace {

double angle_at(const FitState& state, const std::array<VertId, 4>& quad, std::size_t k) {
  const Vec3& o = state.mesh.positions[quad[k]];
  const Vec3 a = normalized(state.mesh.positions[quad[(k + 1) % 4]] - o);
  const Vec3 b = normalized(state.mesh.positions[quad[(k + 3) % 4]] - o);
  return std::acos(std::clamp(dot(a, b), -1.0, 1.0));
}

/// Rewrites marks and vertex attributes after a sheet behind a set went in.
class SetRelabeling {
 public:
  SetRelabeling(FitState& state, FeatureMarks& marks, const MarkedGraph& marked,
                std::span<const char> is_in_set)
      : state_(state), marks_(marks), marked_(marked), is_in_set_(is_in_set) {}

  void run(const Sheet& sheet, const std::vector<VertId>& copies) {
    copy_.assign(marked_.graph.num_verts(), VertId{});
    for (std::size_t i = 0; i < copies.size(); ++i) copy_[sheet.verts[i]] = copies[i];
    std::vector<QuadLabel> labels = label_quads();
    label_rim(labels);
    move_edges();
    state_.resize_arrays();
    for (VertId v : sheet.verts) move_vert(v);
    state_.rebuild();
    restore_regions(state_, std::move(labels), marks_);
  }

 private:
  bool is_in(QuadId q) const { return is_in_set_[state_.quad_face[q.index()].hex.index()] != 0; }
  VertId moved(VertId v) const { return copy_[v].is_valid() ? copy_[v] : v; }

  std::vector<QuadLabel> label_quads() const {
    std::vector<QuadLabel> labels;
    for (QuadId q : marks_.quad_to_region.ids()) {
      auto verts = state_.quads[q.index()];
      if (is_in(q))
        for (VertId& v : verts) v = moved(v);
      labels.push_back({sorted_verts(verts), marks_.quad_to_region[q]});
    }
    return labels;
  }

  /// The sheet's own boundary quads stand on the edges between quads of the set and others.
  void label_rim(std::vector<QuadLabel>& labels) const {
    for (std::size_t i = 0; i < marked_.graph.num_edges(); ++i) {
      const auto& edge = marked_.graph.edge(BoundaryEdgeId(i));
      if (edge.num_quads != 2 || is_in(edge.quads[0]) == is_in(edge.quads[1])) continue;
      const QuadId inner = is_in(edge.quads[0]) ? edge.quads[0] : edge.quads[1];
      labels.push_back({sorted_verts({edge.a, edge.b, moved(edge.a), moved(edge.b)}),
                        marks_.quad_to_region[inner]});
    }
  }

  void move_edges() {
    for (LabeledEdge& edge : marks_.edges) {
      const BoundaryEdgeId e = marked_.graph.find_edge(edge.verts[0], edge.verts[1]);
      if (!e.is_valid()) continue;
      const auto& quads = marked_.graph.edge(e).quads;
      if (!is_in(quads[0]) || !is_in(quads[1])) continue;
      for (VertId& v : edge.verts) v = moved(v);
      std::sort(edge.verts.begin(), edge.verts.end());
    }
    std::sort(marks_.edges.begin(), marks_.edges.end(),
              [](const LabeledEdge& x, const LabeledEdge& y) { return x.verts < y.verts; });
  }

  /// On the rim the copy is a plain vertex of the set's region; elsewhere on the boundary it takes
  /// the original's place.
  void move_vert(VertId v) {
    QuadId inner;
    bool is_rim = false;
    for (QuadId q : marked_.graph.quads(v)) {
      if (is_in(q))
        inner = q;
      else
        is_rim = true;
    }
    if (!inner.is_valid()) return;  // the copy is inside the mesh
    const VertId w = copy_[v];
    state_.target[w] = state_.target[v];
    state_.direction[w] = state_.direction[v];
    if (is_rim) {
      state_.kind[w] = VertKind::Surface;
      state_.patch[w] = marks_.region_to_patch[marks_.quad_to_region[inner]];
      return;
    }
    state_.kind[w] = state_.kind[v];
    state_.patch[w] = state_.patch[v];
    state_.curve[w] = state_.curve[v];
    state_.arc[w] = state_.arc[v];
    state_.feature_point[w] = state_.feature_point[v];
    state_.kind[v] = VertKind::Interior;
  }

  FitState& state_;
  FeatureMarks& marks_;
  const MarkedGraph& marked_;
  std::span<const char> is_in_set_;
  IdVector<VertId, VertId> copy_;  // invalid where the sheet does not pass
};

}  // namespace

MarkedGraph::MarkedGraph(const FitState& state, const FeatureMarks& marks)
    : graph(state.num_verts(), boundary_view(state).quads),
      edge_to_curve(mark_edges(graph, marks.edges)) {}

unsigned squeezed_corners(const FitState& state, const MarkedGraph& marked, QuadId q,
                          double corner_angle) {
  const auto& quad = state.quads[q.index()];
  const auto& edges = marked.graph.quad_edges(q);
  unsigned result = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (!marked.is_marked(edges[k]) || !marked.is_marked(edges[(k + 3) % 4])) continue;
    const VertKind kind = state.kind[quad[k]];
    if (kind == VertKind::Curve ||
        (kind == VertKind::Corner && angle_at(state, quad, k) > corner_angle))
      result |= 1u << k;
  }
  return result;
}

std::vector<QuadId> find_squeezed_quads(const FitState& state, const MarkedGraph& marked,
                                        double corner_angle) {
  std::vector<QuadId> result;
  for (QuadId q : id_range<QuadId>(state.quads.size()))
    if (squeezed_corners(state, marked, q, corner_angle) != 0) result.push_back(q);
  return result;
}

bool insert_behind_set(FitState& state, FeatureMarks& marks, const MarkedGraph& marked,
                       std::span<const char> is_in_set, const Sheet& sheet) {
  constexpr double kMinJacobian = 1e-7;
  const auto copies =
      insert_sheet(state.mesh, state.vert_to_hex, sheet, is_in_set, kMinJacobian).copies;
  if (copies.empty()) return false;
  SetRelabeling(state, marks, marked, is_in_set).run(sheet, copies);
  return true;
}

}  // namespace hexwright::fitting
