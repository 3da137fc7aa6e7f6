// The only file that knows Manifold.
//
// Based on: the library Manifold (Lalish et al.), whose booleans are those of Smith, Dodgson, "A
// topologically robust algorithm for Boolean operations on polyhedral shapes using approximate
// arithmetic", Computer-Aided Design 39(2), 2007.
#include "geometry/prepare/unite_solids.h"

#include <manifold/manifold.h>

namespace hexwright {
namespace {

manifold::Manifold to_manifold(const Solid& solid, std::uint32_t id, double tolerance) {
  manifold::MeshGL64 mesh;
  for (const Vec3& p : solid.mesh.positions)
    for (int axis = 0; axis < 3; ++axis) mesh.vertProperties.push_back(p[axis]);
  for (TriId t : solid.mesh.tris.ids()) {
    for (VertId v : solid.mesh.tris[t]) mesh.triVerts.push_back(v.index());
    mesh.faceID.push_back(solid.tri_to_face[t].index());
  }
  mesh.runIndex = {0, mesh.triVerts.size()};
  mesh.runOriginalID = {id};
  mesh.tolerance = tolerance;
  return manifold::Manifold(mesh);
}

UnitedSurface from_manifold(const manifold::MeshGL64& mesh, std::uint32_t first_id) {
  UnitedSurface result;
  std::vector<VertId> vert(mesh.NumVert());
  for (std::size_t i = 0; i < vert.size(); ++i) vert[i] = VertId(i);
  for (std::size_t i = 0; i < mesh.mergeFromVert.size(); ++i)
    vert[mesh.mergeFromVert[i]] = VertId(mesh.mergeToVert[i]);
  for (std::size_t i = 0; i < vert.size(); ++i) {
    const auto p = mesh.GetVertPos(i);
    result.mesh.positions.push_back({p.x, p.y, p.z});
  }
  for (std::size_t run = 0; run < mesh.NumRun(); ++run)
    for (std::size_t t = mesh.runIndex[run] / 3; t < mesh.runIndex[run + 1] / 3; ++t) {
      const auto tri = mesh.GetTriVerts(t);
      result.mesh.tris.push_back({vert[tri.x], vert[tri.y], vert[tri.z]});
      result.tri_to_solid.push_back(static_cast<int>(mesh.runOriginalID[run] - first_id));
      result.tri_to_face.push_back(TriId(mesh.faceID[t]));
    }
  return result;
}

}  // namespace

UnitedSurface unite_solids(std::span<const Solid> solids, double tolerance) {
  // In one block: the order of the numbers, which the result's order follows, is that of the solids
  // whatever other threads reserve meanwhile.
  const std::uint32_t first_id =
      manifold::Manifold::ReserveIDs(static_cast<std::uint32_t>(solids.size()));
  std::vector<manifold::Manifold> operands;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    operands.push_back(to_manifold(solids[i], first_id + static_cast<std::uint32_t>(i), tolerance));
    if (operands.back().Status() != manifold::Manifold::Error::NoError) return {};
  }
  const manifold::Manifold all = manifold::Manifold::BatchBoolean(operands, manifold::OpType::Add);
  if (all.Status() != manifold::Manifold::Error::NoError) return {};
  return from_manifold(all.GetMeshGL64(), first_id);
}

}  // namespace hexwright
