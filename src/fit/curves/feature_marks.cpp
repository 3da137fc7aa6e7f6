// From a mapping to attributes of the mesh's vertices, edges and quads, and on to labels.
#include "fit/curves/feature_marks.h"

#include <algorithm>
#include <cmath>

#include "hexwright/base/parallel.h"

namespace hexwright::fitting {

using namespace relax;
namespace {

/// Boundary vertices become plain surface vertices.
void forget_features(FitState& state) {
  for (VertId v : state.kind.ids()) {
    if (state.is_boundary(v)) state.kind[v] = VertKind::Surface;
    state.patch[v] = {};
    state.curve[v] = {};
    state.arc[v] = 0;
    state.feature_point[v] = {};
  }
}

void write_curve(FitState& state, const FeatureCurve& curve, CurveId c, const CurvePath& path) {
  for (std::size_t i = 0; i < path.verts.size(); ++i) {
    const VertId v = path.verts[i];
    state.kind[v] = VertKind::Curve;
    state.curve[v] = c;
    state.arc[v] = path.arcs[i];
    if (curve.is_closed) state.arc[v] -= curve.length() * std::floor(path.arcs[i] / curve.length());
  }
}

void write_features(FitState& state, const FeatureGraph& features, const FeatureMapping& mapping) {
  for (CurveId c : mapping.curves.ids())
    write_curve(state, features.curves[c], c, mapping.curves[c]);
  for (std::size_t k = 0; k < features.corners.size(); ++k) {
    const VertId v = mapping.corner_verts[k];
    if (!v.is_valid()) continue;
    state.kind[v] = VertKind::Corner;
    state.curve[v] = {};
    state.feature_point[v] = features.corners[k];
  }
}

}  // namespace

BoundaryQuads boundary_view(const FitState& state) {
  return {IdSpan<VertId, const Vec3>(state.mesh.positions),
          IdSpan<QuadId, const std::array<VertId, 4>>(
              std::span<const std::array<VertId, 4>>(state.quads)),
          IdSpan<VertId, const double>(state.size)};
}

AttachedFeatures attach_features(FitState& state, SurfaceTree& tree, const FeatureGraph& features,
                                 const FeatureMapOptions& options) {
  const BoundaryQuads boundary = boundary_view(state);
  AttachedFeatures result;
  result.mapping = map_features(boundary, tree.surface(), features, options);
  const BoundaryGraph graph(state.num_verts(), boundary.quads);
  result.marks.edges = collect_marked_edges(result.mapping);
  RegionMap regions = compute_regions(graph, mark_edges(graph, result.marks.edges));
  tree.set_patches(compute_patches(tree.surface(), features, mapped_curves(result.mapping)));
  vote_patches(boundary, tree, regions);
  result.marks.quad_to_region = std::move(regions.quad_to_region);
  result.marks.region_to_patch = std::move(regions.region_to_patch);
  forget_features(state);
  write_features(state, features, result.mapping);
  assign_patches(state, result.marks);
  return result;
}

void assign_patches(FitState& state, const FeatureMarks& marks) {
  for (QuadId q : marks.quad_to_region.ids()) {
    const PatchId patch = marks.region_to_patch[marks.quad_to_region[q]];
    for (VertId v : state.quads[q.index()])
      if (state.kind[v] == VertKind::Surface) state.patch[v] = patch;
  }
}

std::array<VertId, 4> sorted_verts(std::array<VertId, 4> quad) {
  std::sort(quad.begin(), quad.end());
  return quad;
}

void restore_regions(const FitState& state, std::vector<QuadLabel> labels, FeatureMarks& marks) {
  const auto less = [](const QuadLabel& x, const QuadLabel& y) { return x.verts < y.verts; };
  std::sort(labels.begin(), labels.end(), less);
  marks.quad_to_region.assign(state.quads.size(), RegionId{});
  for (QuadId q : marks.quad_to_region.ids()) {
    const QuadLabel wanted{sorted_verts(state.quads[q.index()]), {}};
    const auto it = std::lower_bound(labels.begin(), labels.end(), wanted, less);
    if (it != labels.end() && it->verts == wanted.verts) marks.quad_to_region[q] = it->region;
  }
}

namespace {

std::optional<Issue> find_edge_problem(const FitState& state, const FeatureMarks& marks,
                                       const BoundaryGraph& graph) {
  IdVector<VertId, int> num_passes(state.num_verts(), 0);
  for (const LabeledEdge& edge : marks.edges) {
    if (!graph.find_edge(edge.verts[0], edge.verts[1]).is_valid())
      return Issue{"a marked edge is not on the boundary"};
    for (VertId v : edge.verts) {
      if (state.kind[v] != VertKind::Curve && state.kind[v] != VertKind::Corner)
        return Issue{"a marked edge ends off the curves"};
      if (state.kind[v] == VertKind::Curve && state.curve[v] != edge.curve)
        return Issue{"a marked edge belongs to another curve than its vertex"};
      ++num_passes[v];
    }
  }
  for (VertId v : state.kind.ids()) {
    if (state.kind[v] == VertKind::Curve && num_passes[v] != 2)
      return Issue{"a curve does not pass its vertex once"};
    if (state.kind[v] == VertKind::Corner && num_passes[v] == 0)
      return Issue{"no curve ends at a corner"};
  }
  return {};
}

}  // namespace

std::optional<Issue> find_problem(const FitState& state, const FeatureMarks& marks) {
  const BoundaryGraph graph(state.num_verts(), boundary_view(state).quads);
  if (marks.quad_to_region.size() != state.quads.size()) return Issue{"regions do not match quads"};
  for (RegionId r : marks.quad_to_region)
    if (!r.is_valid()) return Issue{"a quad has no region"};
  const auto edge_to_curve = mark_edges(graph, marks.edges);
  for (BoundaryEdgeId e : edge_to_curve.ids()) {
    const auto& quads = graph.edge(e).quads;
    if (graph.edge(e).num_quads == 2 && !edge_to_curve[e].is_valid() &&
        marks.quad_to_region[quads[0]] != marks.quad_to_region[quads[1]])
      return Issue{"regions meet at an unmarked edge"};
  }
  return find_edge_problem(state, marks, graph);
}

BoundaryLabels make_labels(const FitState& state, const FeatureMarks& marks,
                           const SurfaceTree& tree) {
  BoundaryLabels labels;
  labels.quads.resize(state.quads.size());
  const BoundaryQuads boundary = boundary_view(state);
  parallel_for(
      labels.quads.size(),
      [&](std::size_t i) {
        const QuadId q(i);
        PatchId patch = marks.region_to_patch[marks.quad_to_region[q]];
        if (!patch.is_valid()) patch = nearest_patch(boundary, tree, q);
        labels.quads[i] = {state.quads[i], patch};
      },
      1024);
  labels.edges = marks.edges;
  for (VertId v : state.kind.ids())
    if (state.kind[v] == VertKind::Corner) labels.corners.push_back(v);
  return labels;
}

}  // namespace hexwright::fitting
