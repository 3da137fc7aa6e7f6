// Faces and vertices of a sheet.
#include "fit/sheets/sheet.h"

#include <algorithm>

namespace hexwright::fitting {

void Sheet::add_face(const HexMesh& mesh, const HexFace& face) {
  quads.push_back(face_verts(mesh, face));
  behind.push_back(face.hex);
}

void Sheet::add_inner_faces(const HexMesh& mesh, const HexNeighbors& neighbors,
                            std::span<const HexId> hexes, std::span<const char> is_in) {
  for (HexId h : hexes)
    for (int lf = 0; lf < 6; ++lf) {
      const HexId other = neighbors.neighbor[h][static_cast<std::size_t>(lf)];
      if (other.is_valid() && is_in[other.index()] == 0) add_face(mesh, {h, lf});
    }
}

void Sheet::collect_verts() {
  verts.clear();
  for (const auto& quad : quads) verts.insert(verts.end(), quad.begin(), quad.end());
  std::sort(verts.begin(), verts.end());
  verts.erase(std::unique(verts.begin(), verts.end()), verts.end());
}

std::size_t Sheet::index_of(VertId v) const {
  const auto it = std::lower_bound(verts.begin(), verts.end(), v);
  return it != verts.end() && *it == v ? static_cast<std::size_t>(it - verts.begin()) : kNone;
}

}  // namespace hexwright::fitting
