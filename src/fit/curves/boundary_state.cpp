// From a mapping to attributes of the mesh's vertices, edges and quads, and on to labels.
#include "fit/curves/boundary_state.h"

#include <algorithm>
#include <cmath>

#include "hexwright/base/parallel.h"

#include "mesh/quad.h"

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

/// Gives Surface vertices the patch of their region.
void assign_patches(FitState& state, const BoundaryState& boundary) {
  for (QuadId q : boundary.quad_to_region.ids()) {
    const PatchId patch = boundary.region_to_patch[boundary.quad_to_region[q]];
    for (VertId v : state.quads[q.index()])
      if (state.kind[v] == VertKind::Surface) state.patch[v] = patch;
  }
}

std::optional<Issue> find_region_problem(const BoundaryState& boundary) {
  for (RegionId r : boundary.quad_to_region)
    if (!r.is_valid()) return Issue{"a quad has no region"};
  for (BoundaryEdgeId e : boundary.edge_to_curve.ids()) {
    const auto& edge = boundary.graph.edge(e);
    if (edge.num_quads == 2 && !boundary.is_marked(e) &&
        boundary.quad_to_region[edge.quads[0]] != boundary.quad_to_region[edge.quads[1]])
      return Issue{"regions meet at an unmarked edge"};
  }
  return {};
}

std::optional<Issue> find_curve_problem(const FitState& state, const BoundaryState& boundary) {
  IdVector<VertId, int> num_passes(state.num_verts(), 0);
  for (const LabeledEdge& edge : boundary.marked_edges())
    for (VertId v : edge.verts) {
      if (state.kind[v] != VertKind::Curve && state.kind[v] != VertKind::Corner)
        return Issue{"a marked edge ends off the curves"};
      if (state.kind[v] == VertKind::Curve && state.curve[v] != edge.curve)
        return Issue{"a marked edge belongs to another curve than its vertex"};
      ++num_passes[v];
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

BoundaryQuads boundary_view(const FitState& state) {
  return {IdSpan<VertId, const Vec3>(state.mesh.positions),
          IdSpan<QuadId, const std::array<VertId, 4>>(
              std::span<const std::array<VertId, 4>>(state.quads)),
          IdSpan<VertId, const double>(state.size)};
}

std::vector<LabeledEdge> BoundaryState::marked_edges() const {
  std::vector<LabeledEdge> edges;
  for (BoundaryEdgeId e : edge_to_curve.ids())
    if (is_marked(e)) edges.push_back({{graph.edge(e).a, graph.edge(e).b}, edge_to_curve[e]});
  return edges;
}

void BoundaryState::rebuild(const FitState& state, const std::vector<LabeledEdge>& marked,
                            std::vector<QuadLabel> labels) {
  graph = BoundaryGraph(state.num_verts(), boundary_view(state).quads);
  edge_to_curve = mark_edges(graph, marked);
  const auto less = [](const QuadLabel& x, const QuadLabel& y) { return x.verts < y.verts; };
  std::sort(labels.begin(), labels.end(), less);
  quad_to_region.assign(state.quads.size(), RegionId{});
  for (QuadId q : quad_to_region.ids()) {
    const QuadLabel wanted{sorted(state.quads[q.index()]), {}};
    const auto it = std::lower_bound(labels.begin(), labels.end(), wanted, less);
    if (it != labels.end() && it->verts == wanted.verts) quad_to_region[q] = it->region;
  }
}

std::optional<Issue> BoundaryState::find_problem(const FitState& state) const {
  if (quad_to_region.size() != state.quads.size() || graph.num_quads() != state.quads.size())
    return Issue{"the boundary is that of another mesh"};
  for (QuadId q : quad_to_region.ids())
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& quad = state.quads[q.index()];
      if (graph.find_edge(quad[k], quad[(k + 1) % 4]) != graph.quad_edges(q)[k])
        return Issue{"the boundary is that of another mesh"};
    }
  if (auto issue = find_region_problem(*this)) return issue;
  return find_curve_problem(state, *this);
}

AttachedFeatures attach_features(FitState& state, const SurfaceTree& tree,
                                 const FeatureGraph& features, const FeatureMapOptions& options) {
  const BoundaryQuads view = boundary_view(state);
  AttachedFeatures result;
  BoundaryState& boundary = result.boundary;
  result.mapping = map_features(view, tree.surface(), features, options);
  boundary.graph = BoundaryGraph(state.num_verts(), view.quads);
  boundary.edge_to_curve = mark_edges(boundary.graph, collect_marked_edges(result.mapping));
  RegionMap regions = compute_regions(boundary.graph, boundary.edge_to_curve);
  result.patches =
      PatchIndex(tree, compute_patches(tree.surface(), features, mapped_curves(result.mapping)));
  vote_patches(view, tree, result.patches, regions);
  boundary.quad_to_region = std::move(regions.quad_to_region);
  boundary.region_to_patch = std::move(regions.region_to_patch);
  forget_features(state);
  write_features(state, features, result.mapping);
  assign_patches(state, boundary);
  return result;
}

BoundaryLabels make_labels(const FitState& state, const BoundaryState& boundary,
                           const SurfaceTree& tree, const PatchIndex& patches) {
  BoundaryLabels labels;
  labels.quads.resize(state.quads.size());
  const BoundaryQuads view = boundary_view(state);
  parallel_for(
      labels.quads.size(),
      [&](std::size_t i) {
        const QuadId q(i);
        PatchId patch = boundary.region_to_patch[boundary.quad_to_region[q]];
        if (!patch.is_valid()) patch = nearest_patch(view, tree, patches, q);
        labels.quads[i] = {state.quads[i], patch};
      },
      1024);
  labels.edges = boundary.marked_edges();
  for (VertId v : state.kind.ids())
    if (state.kind[v] == VertKind::Corner) labels.corners.push_back(v);
  return labels;
}

}  // namespace hexwright::fitting
