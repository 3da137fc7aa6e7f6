// Voxel meshes and matching surfaces for the tests of feature mapping and padding.
#pragma once

#include <cmath>
#include <functional>

#include "hexwright/fit/carve.h"
#include "hexwright/mesh/hex_adjacency.h"

#include "fit/curves/map_features.h"
#include "helpers.h"
#include "relax/kernel/boundary_quads.h"
#include "solids.h"

namespace hexwright::test {

using relax::BoundaryQuads;

/// Boundary quads that own their arrays.
struct OwnedBoundary {
  IdVector<VertId, Vec3> positions;
  IdVector<QuadId, std::array<VertId, 4>> quads;
  IdVector<VertId, double> edge_length;
  BoundaryQuads view() const {
    return {IdSpan<VertId, const Vec3>(positions),
            IdSpan<QuadId, const std::array<VertId, 4>>(quads),
            IdSpan<VertId, const double>(edge_length)};
  }
};

inline OwnedBoundary boundary_of(const HexMesh& mesh) {
  OwnedBoundary b;
  b.positions = mesh.positions;
  for (const HexFace& face : compute_hex_neighbors(mesh).boundary)
    b.quads.push_back(face_verts(mesh, face));
  b.edge_length = relax::compute_edge_lengths(IdSpan<VertId, const Vec3>(b.positions),
                                              IdSpan<QuadId, const std::array<VertId, 4>>(b.quads));
  return b;
}

/// The boundary quads of a hex mesh, each cut in two triangles; welded, without stray vertices.
inline TriMesh surface_of(const HexMesh& mesh) {
  TriMesh surface;
  IdVector<VertId, VertId> old_to_new(mesh.num_verts());
  for (const HexFace& face : compute_hex_neighbors(mesh).boundary) {
    auto q = face_verts(mesh, face);
    for (VertId& v : q) {
      if (!old_to_new[v].is_valid()) old_to_new[v] = surface.positions.push_back(mesh.positions[v]);
      v = old_to_new[v];
    }
    surface.tris.push_back({q[0], q[1], q[2]});
    surface.tris.push_back({q[0], q[2], q[3]});
  }
  return surface;
}

/// The unit hexes of an n x n x n box whose centre satisfies a predicate.
inline HexMesh voxels(int n, const std::function<bool(const Vec3&)>& is_inside) {
  const HexMesh box = box_hex_mesh(n, n, n);
  std::vector<char> is_kept(box.num_hexes(), 0);
  for (HexId h : box.hexes.ids()) {
    Vec3 center;
    for (const Vec3& p : box.corners(h)) center += p / 8;
    is_kept[h.index()] = is_inside(center) ? 1 : 0;
  }
  HexMesh mesh;
  mesh.positions = box.positions;
  for (HexId h : box.hexes.ids())
    if (is_kept[h.index()]) mesh.hexes.push_back(box.hexes[h]);
  remove_unused_verts(mesh);
  return mesh;
}

inline void transform(IdVector<VertId, Vec3>& positions,
                      const std::function<Vec3(const Vec3&)>& f) {
  for (Vec3& p : positions) p = f(p);
}

/// Rotation about a general axis, to leave the grid's directions.
inline Vec3 rotated(const Vec3& p, double a) {
  const double c = std::cos(a), s = std::sin(a);
  const Vec3 q = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  return {q.x, c * q.y - s * q.z, s * q.y + c * q.z};
}

}  // namespace hexwright::test
