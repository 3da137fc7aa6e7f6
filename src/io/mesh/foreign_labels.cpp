// Quads are matched with the faces of hexes by their sorted vertices.
#include "io/mesh/foreign_labels.h"

#include <algorithm>

#include "hexwright/base/parallel.h"

namespace hexwright::io {
namespace {

using Quad = std::array<VertId, 4>;

Quad sorted(Quad verts) {
  std::sort(verts.begin(), verts.end());
  return verts;
}

struct KeyedFace {
  Quad key, verts;
};

std::vector<KeyedFace> sorted_faces(const VolumeFile& file) {
  std::vector<KeyedFace> faces(6 * file.hexes.size());
  parallel_for(faces.size(), [&](std::size_t i) {
    const auto& hex = file.hexes[HexId(i / 6)];
    for (std::size_t k = 0; k < 4; ++k)
      faces[i].verts[k] = hex[static_cast<std::size_t>(kHexFaces[i % 6][k])];
    faces[i].key = sorted(faces[i].verts);
  });
  parallel_stable_sort(faces.begin(), faces.end(),
                       [](const KeyedFace& a, const KeyedFace& b) { return a.key < b.key; });
  return faces;
}

/// False for a quad that is no face.
bool settle(const std::vector<KeyedFace>& faces, LabeledQuad& quad) {
  const auto less = [](const KeyedFace& face, const Quad& key) { return face.key < key; };
  const Quad key = sorted(quad.verts);
  const auto found = std::lower_bound(faces.begin(), faces.end(), key, less);
  if (found == faces.end() || found->key != key) return false;
  const bool is_inner = found + 1 != faces.end() && (found + 1)->key == key;
  if (!is_inner) quad.verts = found->verts;
  return true;
}

void drop_unused(VolumeFile& file) {
  IdVector<VertId, VertId> old_to_new(file.positions.size());
  for (const auto& hex : file.hexes)
    for (VertId v : hex) old_to_new[v] = VertId(0);
  for (const auto& tet : file.tets)
    for (VertId v : tet) old_to_new[v] = VertId(0);
  IdVector<VertId, Vec3> positions;
  for (VertId v : file.positions.ids())
    if (old_to_new[v].is_valid()) old_to_new[v] = positions.push_back(file.positions[v]);
  file.positions = std::move(positions);
  const auto renumber = [&](auto& verts) {
    for (VertId& v : verts) v = old_to_new[v];
  };
  const auto is_lost = [](const auto& labeled) {
    return std::any_of(labeled.verts.begin(), labeled.verts.end(),
                       [](VertId v) { return !v.is_valid(); });
  };
  for (auto& hex : file.hexes) renumber(hex);
  for (auto& tet : file.tets) renumber(tet);
  for (LabeledQuad& quad : file.labels.quads) renumber(quad.verts);
  for (LabeledEdge& edge : file.labels.edges) renumber(edge.verts);
  renumber(file.labels.corners);
  file.num_others += std::erase_if(file.labels.edges, is_lost);
  file.num_others += std::erase_if(file.labels.corners, [](VertId v) { return !v.is_valid(); });
}

}  // namespace

void settle_labels(VolumeFile& file) {
  if (file.hexes.empty()) return;
  if (!file.labels.quads.empty()) {
    const std::vector<KeyedFace> faces = sorted_faces(file);
    file.num_others +=
        std::erase_if(file.labels.quads, [&](LabeledQuad& quad) { return !settle(faces, quad); });
  }
  drop_unused(file);
}

}  // namespace hexwright::io
