// Faces sorted by their sorted vertices.
#include "io/sets/face_table.h"

#include <algorithm>

#include "hexwright/base/parallel.h"

#include "mesh/quad.h"

namespace hexwright::io {
std::array<VertId, 4> face_verts(const Hexes& hexes, HexFace face) {
  std::array<VertId, 4> verts;
  for (std::size_t k = 0; k < 4; ++k) {
    const int lv = kHexFaces[static_cast<std::size_t>(face.lf)][k];
    verts[k] = hexes[face.hex][static_cast<std::size_t>(lv)];
  }
  return verts;
}

FaceTable::FaceTable(const Hexes& hexes) : faces_(6 * hexes.size()) {
  parallel_for(faces_.size(), [&](std::size_t i) {
    const HexFace face = {HexId(i / 6), static_cast<int>(i % 6)};
    faces_[i] = {sorted(face_verts(hexes, face)), face};
  });
  parallel_stable_sort(faces_.begin(), faces_.end(),
                       [](const KeyedFace& a, const KeyedFace& b) { return a.key < b.key; });
}

std::optional<FaceTable::Found> FaceTable::find(const std::array<VertId, 4>& verts) const {
  const auto key = sorted(verts);
  const auto less = [](const KeyedFace& face, const std::array<VertId, 4>& k) {
    return face.key < k;
  };
  const auto found = std::lower_bound(faces_.begin(), faces_.end(), key, less);
  if (found == faces_.end() || found->key != key) return std::nullopt;
  const auto next = found + 1;
  return Found{found->face, next != faces_.end() && next->key == key};
}

}  // namespace hexwright::io
