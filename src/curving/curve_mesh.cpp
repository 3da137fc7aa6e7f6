// Targets of mid-nodes, and how far towards them the elements allow.
#include "hexwright/curving/curve_mesh.h"

#include <algorithm>

#include "curving/edge_targets.h"
#include "curving/hold_back.h"

namespace hexwright {

using namespace curving;

void CurvingReport::to_world(const Similarity& frame) {
  max_offset = frame.length_to_world(max_offset);
  for (HeldBackEdge& edge : held_back) edge.to_world(frame);
}

CurvingReport curve_mesh(HexMesh& mesh, const CurvingTarget& target, const Context& context) {
  const auto watch = context.watch();
  context.progress("curve", 0);
  mesh.mid_nodes = make_straight_mid_nodes(mesh);
  const EdgeTargets targets = find_edge_targets(mesh, target);
  context.check_cancelled();
  context.progress("curve", 0.5);
  const auto share = hold_back(targets.offset, mesh);

  CurvingReport report;
  report.num_edges = share.size();
  for (EdgeId e : share.ids()) {
    if (targets.kind[e] == EdgeKind::Inner) continue;
    ++report.num_surface_edges;
    if (targets.kind[e] == EdgeKind::Unmatched) ++report.num_unmatched;
    const double length = norm(targets.offset[e]);
    if (share[e] > 0 && length > 0) ++report.num_curved;
    report.max_offset = std::max(report.max_offset, share[e] * length);
    if (share[e] < 1)
      report.held_back.push_back({mesh.mid_nodes->edges[e], share[e], (1 - share[e]) * length});
  }
  std::stable_sort(
      report.held_back.begin(), report.held_back.end(),
      [](const HeldBackEdge& a, const HeldBackEdge& b) { return a.distance > b.distance; });
  context.progress("curve", 1);
  return report;
}

}  // namespace hexwright
