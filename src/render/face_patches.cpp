#include "render/face_patches.h"

#include <algorithm>

#include "hexwright/io/set_table.h"

namespace hexwright {
std::vector<PatchId> find_face_patches(const HexMesh& mesh) {
  const auto& quads = mesh.labels.quads;
  if (std::none_of(quads.begin(), quads.end(), [](const auto& q) { return q.patch.is_valid(); }))
    return {};
  std::vector<PatchId> patches(6 * mesh.num_hexes());
  const VertToHex vert_to_hex(mesh);
  for (const LabeledQuad& quad : quads)
    for (const HexFace& face : find_quad_faces(mesh, vert_to_hex, quad.verts))
      patches[face_slot(face)] = quad.patch;
  return patches;
}

}  // namespace hexwright
