// Union-find over the quads at a vertex.
#include "fit/sheets/quad_fans.h"

#include <algorithm>

#include "geometry/topology/surface_edges.h"

namespace hexwright::fitting {

using namespace relax;

QuadFans find_quad_fans(const BoundaryState& boundary, VertId v,
                        FunctionRef<bool(QuadId)> is_inside) {
  const auto quads = boundary.graph.quads(v);
  UnionFind parts(quads.size());
  const auto index_of = [&](QuadId q) {
    return static_cast<int>(std::lower_bound(quads.begin(), quads.end(), q) - quads.begin());
  };
  QuadFans fans;
  for (BoundaryEdgeId e : boundary.graph.edges(v)) {
    const auto& edge = boundary.graph.edge(e);
    if (edge.num_quads != 2) continue;
    const bool inside = is_inside(edge.quads[0]);
    if (inside != is_inside(edge.quads[1])) continue;
    parts.unite(index_of(edge.quads[0]), index_of(edge.quads[1]));
    if (!inside && boundary.is_marked(e)) fans.marked_outside.push_back(e);
  }
  for (QuadId q : quads)
    if (parts.find(index_of(q)) == index_of(q))
      ++(is_inside(q) ? fans.num_inside : fans.num_outside);
  return fans;
}

}  // namespace hexwright::fitting
