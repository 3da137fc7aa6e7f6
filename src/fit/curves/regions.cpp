// Flood fill of quads and the vote of their areas.
#include "fit/curves/regions.h"

#include <algorithm>
#include <tuple>

#include "hexwright/base/parallel.h"

#include "mesh/quad.h"

namespace hexwright::fitting {

using namespace relax;
namespace {

struct Ballot {
  RegionId region;
  PatchId patch;
  double area = 0;
};

}  // namespace

PatchId nearest_patch(const BoundaryQuads& boundary, const SurfaceTree& tree,
                      const PatchIndex& patches, QuadId q) {
  std::array<Vec3, 4> p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = boundary.positions[boundary.quads[q][k]];
  const Vec3 center = (p[0] + p[1] + p[2] + p[3]) * 0.25;
  ClosestFilter facing;
  facing.normal = normalized(cross(p[2] - p[0], p[3] - p[1]));
  facing.min_cosine = 0.3;
  auto nearest = tree.closest(center, facing);
  if (!nearest) nearest = tree.closest(center);
  return nearest ? patches.patch(nearest->tri) : PatchId{};
}

std::vector<LabeledEdge> collect_marked_edges(const FeatureMapping& mapping) {
  std::vector<LabeledEdge> marked;
  for (CurveId c : mapping.curves.ids()) {
    const auto& verts = mapping.curves[c].verts;
    for (std::size_t i = 0; i + 1 < verts.size(); ++i)
      marked.push_back({{std::min(verts[i], verts[i + 1]), std::max(verts[i], verts[i + 1])}, c});
  }
  std::sort(marked.begin(), marked.end(), [](const LabeledEdge& x, const LabeledEdge& y) {
    return std::tie(x.verts, x.curve) < std::tie(y.verts, y.curve);
  });
  return marked;
}

IdVector<BoundaryEdgeId, CurveId> mark_edges(const BoundaryGraph& graph,
                                             const std::vector<LabeledEdge>& marked) {
  IdVector<BoundaryEdgeId, CurveId> edge_to_curve(graph.num_edges());
  for (const LabeledEdge& edge : marked) {
    const BoundaryEdgeId e = graph.find_edge(edge.verts[0], edge.verts[1]);
    if (e.is_valid()) edge_to_curve[e] = edge.curve;
  }
  return edge_to_curve;
}

RegionMap compute_regions(const BoundaryGraph& graph,
                          const IdVector<BoundaryEdgeId, CurveId>& edge_to_curve) {
  RegionMap regions;
  regions.quad_to_region.resize(graph.num_quads());
  std::vector<QuadId> stack;
  for (QuadId seed : regions.quad_to_region.ids()) {
    if (regions.quad_to_region[seed].is_valid()) continue;
    const RegionId region = regions.region_to_patch.push_back({});
    regions.quad_to_region[seed] = region;
    stack.push_back(seed);
    while (!stack.empty()) {
      const QuadId q = stack.back();
      stack.pop_back();
      for (BoundaryEdgeId e : graph.quad_edges(q)) {
        if (edge_to_curve[e].is_valid() || graph.edge(e).num_quads != 2) continue;
        const QuadId next = graph.edge(e).other(q);
        if (regions.quad_to_region[next].is_valid()) continue;
        regions.quad_to_region[next] = region;
        stack.push_back(next);
      }
    }
  }
  return regions;
}

void vote_patches(const BoundaryQuads& boundary, const SurfaceTree& tree, const PatchIndex& patches,
                  RegionMap& regions) {
  std::vector<Ballot> ballots(boundary.quads.size());
  parallel_for(
      ballots.size(),
      [&](std::size_t i) {
        const QuadId q(i);
        ballots[i] = {regions.quad_to_region[q], nearest_patch(boundary, tree, patches, q),
                      quad_area(boundary.positions, boundary.quads[q])};
      },
      64);
  std::stable_sort(ballots.begin(), ballots.end(), [](const Ballot& x, const Ballot& y) {
    return std::tie(x.region, x.patch) < std::tie(y.region, y.patch);
  });
  for (std::size_t begin = 0, end = 0; begin < ballots.size(); begin = end) {
    const RegionId region = ballots[begin].region;
    double total = 0, best_area = 0, area = 0;
    PatchId best;
    for (end = begin; end < ballots.size() && ballots[end].region == region; ++end) {
      area = end > begin && ballots[end].patch == ballots[end - 1].patch ? area : 0;
      area += ballots[end].area;
      total += ballots[end].area;
      if (ballots[end].patch.is_valid() && area > best_area) {
        best_area = area;
        best = ballots[end].patch;
      }
    }
    if (best_area > 0.5 * total) regions.region_to_patch[region] = best;
  }
}

std::vector<char> mapped_curves(const FeatureMapping& mapping) {
  std::vector<char> is_mapped;
  for (const CurvePath& path : mapping.curves) is_mapped.push_back(path.is_mapped() ? 1 : 0);
  return is_mapped;
}

}  // namespace hexwright::fitting
