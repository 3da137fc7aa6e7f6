// Groups by source; those of patches over holes by the lengths of their borders.
#include "geometry/prepare/surface_groups.h"

#include <algorithm>
#include <map>

#include "geometry/topology/surface_edges.h"

namespace hexwright {
namespace {

/// The connected patches of triangles without a source, by their numbers in `sets`, and per patch
/// the length of border that it has with each group.
std::map<int, std::map<std::int32_t, double>> find_patch_borders(const PreparedSurface& prepared,
                                                                 UnionFind& sets) {
  const TriMesh& mesh = prepared.mesh;
  const SurfaceEdges edges = compute_surface_edges(mesh);
  const auto is_made = [&](TriId t) { return !prepared.source_tri[t].is_valid(); };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges.sides_of(e);
    for (const auto& side : sides)
      if (is_made(side.tri) && is_made(sides[0].tri))
        sets.unite(sides[0].tri.value(), side.tri.value());
  }
  std::map<int, std::map<std::int32_t, double>> borders;
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const auto& made : edges.sides_of(e))
      for (const auto& given : edges.sides_of(e))
        if (is_made(made.tri) && !is_made(given.tri))
          borders[sets.find(made.tri.value())][mesh.group[given.tri]] +=
              distance(mesh.positions[edges.lo(e)], mesh.positions[edges.hi(e)]);
  return borders;
}

}  // namespace

void carry_groups(const TriMesh& input, PreparedSurface& prepared) {
  if (input.group.empty()) return;
  TriMesh& mesh = prepared.mesh;
  mesh.group_names = input.group_names;
  mesh.group.assign(mesh.num_tris(), -1);
  bool has_made = false;
  for (TriId t : mesh.tris.ids()) {
    const TriId source = prepared.source_tri[t];
    if (source.is_valid()) mesh.group[t] = input.group[source];
    has_made = has_made || !source.is_valid();
  }
  if (!has_made) return;
  UnionFind sets(mesh.num_tris());
  const auto borders = find_patch_borders(prepared, sets);
  for (TriId t : mesh.tris.ids()) {
    if (prepared.source_tri[t].is_valid()) continue;
    const auto found = borders.find(sets.find(t.value()));
    if (found == borders.end() || found->second.size() < 2) continue;
    mesh.group[t] =
        std::max_element(found->second.begin(), found->second.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; })
            ->first;
  }
}

}  // namespace hexwright
