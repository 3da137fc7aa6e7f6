// Checks and small helpers of the three mesh types.
#include <cmath>

#include "hexwright/base/cancel.h"
#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/mesh/tet_mesh.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {
namespace {

std::optional<Issue> find_bad_position(const IdVector<VertId, Vec3>& positions) {
  for (VertId v : positions.ids())
    if (!is_finite(positions[v]))
      return Issue{"vertex " + std::to_string(v.value()) + " has a coordinate that is not finite"};
  return std::nullopt;
}

template <class IdType, std::size_t N>
std::optional<Issue> find_bad_index(const IdVector<IdType, std::array<VertId, N>>& elements,
                                    std::size_t num_verts, const char* name) {
  CancelCheck check_cancelled;
  for (IdType e : elements.ids()) {
    check_cancelled();
    for (VertId v : elements[e])
      if (!v.is_valid() || v.index() >= num_verts)
        return Issue{std::string(name) + " " + std::to_string(e.value()) + " uses vertex " +
                     std::to_string(v.value()) + " of " + std::to_string(num_verts)};
  }
  return std::nullopt;
}

/// Either nothing has a name, or every number has an entry.
template <class IdType>
bool has_entry(const IdVector<IdType, std::string>& names, IdType id) {
  return names.empty() || !id.is_valid() || id.index() < names.size();
}

std::optional<Issue> find_bad_label(const BoundaryLabels& labels, std::size_t num_verts) {
  const auto in_range = [&](VertId v) { return v.is_valid() && v.index() < num_verts; };
  for (const auto& quad : labels.quads) {
    for (VertId v : quad.verts)
      if (!in_range(v)) return Issue{"a labelled quad uses a vertex out of range"};
    if (!has_entry(labels.patch_names, quad.patch))
      return Issue{"patch " + std::to_string(quad.patch.value()) + " has no entry among the " +
                   std::to_string(labels.patch_names.size()) + " names of patches"};
  }
  for (const auto& edge : labels.edges) {
    for (VertId v : edge.verts)
      if (!in_range(v)) return Issue{"a labelled edge uses a vertex out of range"};
    if (!has_entry(labels.curve_names, edge.curve))
      return Issue{"curve " + std::to_string(edge.curve.value()) + " has no entry among the " +
                   std::to_string(labels.curve_names.size()) + " names of curves"};
  }
  for (VertId v : labels.corners)
    if (!in_range(v)) return Issue{"a labelled corner is out of range"};
  return std::nullopt;
}

/// Vertices that nothing uses may lie anywhere, also at infinity: they do not count.
template <class Elements>
Box3 box_of_used(const IdVector<VertId, Vec3>& positions, const Elements& elements) {
  Box3 box;
  CancelCheck check_cancelled;
  for (const auto& element : elements) {
    check_cancelled();
    for (VertId v : element) box.extend(positions[v]);
  }
  return box;
}

}  // namespace

std::optional<Issue> TriMesh::find_problem() const {
  if (auto issue = find_bad_index(tris, num_verts(), "triangle")) return issue;
  if (!group.empty() && group.size() != num_tris())
    return Issue{"groups do not match the number of triangles"};
  for (TriId t : group.ids())
    if (group[t] < -1 || group[t] >= static_cast<std::int64_t>(group_names.size()))
      return Issue{"triangle " + std::to_string(t.value()) + " is in group " +
                   std::to_string(group[t]) + " of " + std::to_string(group_names.size())};
  return find_bad_position(positions);
}

std::optional<Issue> TetMesh::find_problem() const {
  if (auto issue = find_bad_index(tets, num_verts(), "tetrahedron")) return issue;
  return find_bad_position(positions);
}

std::optional<Issue> HexMesh::find_problem() const {
  if (auto issue = find_bad_index(hexes, num_verts(), "hex")) return issue;
  if (!region.empty() && region.size() != num_hexes())
    return Issue{"region tags do not match the number of hexes"};
  if (auto issue = find_bad_label(labels, num_verts())) return issue;
  if (mid_nodes)
    if (auto issue = mid_nodes->find_problem(num_hexes())) return issue;
  return find_bad_position(positions);
}

Box3 bounding_box(const TriMesh& surface) { return box_of_used(surface.positions, surface.tris); }

Box3 bounding_box(const HexMesh& mesh) { return box_of_used(mesh.positions, mesh.hexes); }

/// Labels may only use vertices that hexes use, so they always find a new number.
void remove_unused_verts(HexMesh& mesh) {
  IdVector<VertId, VertId> old_to_new(mesh.num_verts());
  for (const auto& hex : mesh.hexes)
    for (VertId v : hex) old_to_new[v] = VertId(0);  // marks a used vertex; renumbered below
  IdVector<VertId, Vec3> positions;
  for (VertId v : mesh.positions.ids())
    if (old_to_new[v].is_valid()) old_to_new[v] = positions.push_back(mesh.positions[v]);
  mesh.positions = std::move(positions);
  for (auto& hex : mesh.hexes)
    for (VertId& v : hex) v = old_to_new[v];
  for (auto& quad : mesh.labels.quads)
    for (VertId& v : quad.verts) v = old_to_new[v];
  for (auto& edge : mesh.labels.edges)
    for (VertId& v : edge.verts) v = old_to_new[v];
  for (VertId& v : mesh.labels.corners) v = old_to_new[v];
}

}  // namespace hexwright
