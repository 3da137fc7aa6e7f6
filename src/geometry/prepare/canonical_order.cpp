#include "geometry/prepare/canonical_order.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "hexwright/base/parallel.h"

namespace hexwright {
namespace {

IdVector<VertId, VertId> number_by_place(const TriMesh& mesh) {
  std::vector<VertId> order;
  for (VertId v : mesh.positions.ids()) order.push_back(v);
  parallel_stable_sort(order.begin(), order.end(), [&](VertId a, VertId b) {
    const Vec3 &p = mesh.positions[a], &q = mesh.positions[b];
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
  });
  IdVector<VertId, VertId> old_to_new(mesh.num_verts());
  for (std::size_t i = 0; i < order.size(); ++i) old_to_new[order[i]] = VertId(i);
  return old_to_new;
}

struct SourcedTri {
  std::array<VertId, 3> verts;
  TriId source;
};

}  // namespace

IdVector<VertId, Vec3> renumber(const IdVector<VertId, Vec3>& positions,
                                const IdVector<VertId, VertId>& old_to_new) {
  IdVector<VertId, Vec3> out(positions.size());
  for (VertId v : positions.ids()) out[old_to_new[v]] = positions[v];
  return out;
}

IdVector<VertId, VertId> put_in_canonical_order(TriMesh& mesh, IdVector<TriId, TriId>& source) {
  auto old_to_new = number_by_place(mesh);
  mesh.positions = renumber(mesh.positions, old_to_new);

  std::vector<SourcedTri> tris;
  tris.reserve(mesh.num_tris());
  for (TriId t : mesh.tris.ids()) {
    std::array<VertId, 3> verts = mesh.tris[t];
    for (VertId& v : verts) v = old_to_new[v];
    std::rotate(verts.begin(), std::min_element(verts.begin(), verts.end()), verts.end());
    tris.push_back({verts, source[t]});
  }
  parallel_stable_sort(tris.begin(), tris.end(),
                       [](const SourcedTri& a, const SourcedTri& b) { return a.verts < b.verts; });
  for (std::size_t i = 0; i < tris.size(); ++i) {
    mesh.tris[TriId(i)] = tris[i].verts;
    source[TriId(i)] = tris[i].source;
  }
  return old_to_new;
}

}  // namespace hexwright
