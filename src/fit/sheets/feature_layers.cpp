// Squeezed quads.
#include "fit/sheets/feature_layers.h"

#include <algorithm>
#include <cmath>

namespace hexwright::fitting {
namespace {

double angle_at(const FitState& state, const std::array<VertId, 4>& quad, std::size_t k) {
  const Vec3& o = state.mesh.positions[quad[k]];
  const Vec3 a = normalized(state.mesh.positions[quad[(k + 1) % 4]] - o);
  const Vec3 b = normalized(state.mesh.positions[quad[(k + 3) % 4]] - o);
  return std::acos(std::clamp(dot(a, b), -1.0, 1.0));
}

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

}  // namespace hexwright::fitting
