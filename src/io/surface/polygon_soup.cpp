// Triangulates the polygons of surface files.
#include "io/surface/polygon_soup.h"

#include <array>

#include "hexwright/base/cancel.h"

#include "io/surface/ear_clipping.h"

namespace hexwright::io {
namespace {

using Tri = std::array<VertId, 3>;

Vec3 tri_normal(const IdVector<VertId, Vec3>& positions, const Tri& t) {
  return cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
}

/// The fold of a quad split into two triangles: cosine between their normals, -1 when one is flat.
double fold_cosine(const IdVector<VertId, Vec3>& positions, const Tri& a, const Tri& b) {
  const Vec3 na = normalized(tri_normal(positions, a)), nb = normalized(tri_normal(positions, b));
  return norm_sq(na) > 0 && norm_sq(nb) > 0 ? dot(na, nb) : -1;
}

void split_quad(const IdVector<VertId, Vec3>& positions, std::span<const VertId> q,
                std::vector<Tri>& out) {
  const Tri a0 = {q[0], q[1], q[2]}, a1 = {q[0], q[2], q[3]};
  const Tri b0 = {q[1], q[2], q[3]}, b1 = {q[1], q[3], q[0]};
  const double fold_a = fold_cosine(positions, a0, a1);
  const double fold_b = fold_cosine(positions, b0, b1);
  constexpr double kTie = 1e-9;  // planar quads differ by rounding only: they keep diagonal 0-2
  const bool use_b = fold_b > fold_a + kTie;
  out.push_back(use_b ? b0 : a0);
  out.push_back(use_b ? b1 : a1);
}

void split_polygon(const IdVector<VertId, Vec3>& positions, std::span<const VertId> polygon,
                   std::vector<Tri>& out) {
  if (polygon.size() == 3)
    out.push_back({polygon[0], polygon[1], polygon[2]});
  else if (polygon.size() == 4)
    split_quad(positions, polygon, out);
  else
    clip_ears(positions, polygon, out);
}

}  // namespace

TriMesh triangulate(PolygonSoup&& soup) {
  TriMesh mesh;
  mesh.positions = std::move(soup.positions);
  auto& tris = mesh.tris.raw();
  tris.reserve(soup.ends.size());
  std::size_t begin = 0;
  CancelCheck check_cancelled;
  for (std::size_t end : soup.ends) {
    check_cancelled();
    split_polygon(mesh.positions, std::span(soup.verts).subspan(begin, end - begin), tris);
    begin = end;
  }
  return mesh;
}

}  // namespace hexwright::io
