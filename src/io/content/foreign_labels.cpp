// Quads are matched with the faces of hexes by their vertices.
#include "io/content/foreign_labels.h"

#include <algorithm>

#include "io/sets/face_table.h"

namespace hexwright::io {
namespace {

/// False for a quad that is no face.
bool settle(const Hexes& hexes, const FaceTable& faces, LabeledQuad& quad) {
  const auto found = faces.find(quad.verts);
  if (found && !found->is_inner) quad.verts = face_verts(hexes, found->face);
  return found.has_value();
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
    const FaceTable faces(file.hexes);
    file.num_others += std::erase_if(
        file.labels.quads, [&](LabeledQuad& quad) { return !settle(file.hexes, faces, quad); });
  }
  drop_unused(file);
}

}  // namespace hexwright::io
