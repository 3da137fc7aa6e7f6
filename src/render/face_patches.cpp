#include "render/face_patches.h"

#include <algorithm>

#include <fmt/format.h>

namespace hexwright {
namespace {

std::array<VertId, 4> sorted(std::array<VertId, 4> quad) {
  std::sort(quad.begin(), quad.end());
  return quad;
}

}  // namespace

std::vector<PatchId> find_face_patches(const HexMesh& mesh) {
  const auto& quads = mesh.labels.quads;
  if (std::none_of(quads.begin(), quads.end(), [](const auto& q) { return q.patch.is_valid(); }))
    return {};
  std::vector<PatchId> patches(6 * mesh.num_hexes());
  const VertToHex vert_to_hex(mesh);
  for (const LabeledQuad& quad : quads) {
    const auto wanted = sorted(quad.verts);
    for (const HexCorner& corner : vert_to_hex[quad.verts[0]])
      for (int lf = 0; lf < 6; ++lf) {
        const HexFace face{corner.hex, lf};
        if (sorted(face_verts(mesh, face)) == wanted) patches[face_slot(face)] = quad.patch;
      }
  }
  return patches;
}

std::string patch_name(const HexMesh& mesh, PatchId patch) {
  const auto& names = mesh.labels.patch_names;
  const bool has_name = patch.index() < names.size() && !names[patch].empty();
  return has_name ? names[patch] : fmt::format("patch_{}", patch.value());
}

}  // namespace hexwright
