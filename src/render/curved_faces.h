// Faces as they are drawn: lit, and those of second order divided.
#pragma once

#include <array>
#include <vector>

#include "hexwright/mesh/hex_mesh.h"

#include "render/camera.h"
#include "render/rasterizer.h"
#include "render/visible_faces.h"

namespace hexwright {

/// Sets corners, side and light of a quad. It is seen from behind when it runs clockwise on the
/// screen: from inside its hex, through a cut or because the hex is inverted. Its normal is turned
/// to the eye, for light has no inside.
void light_quad(const std::array<Vec3, 4>& corners, const Camera& camera, ShadedQuad& quad);

/// The quads of faces, where those with curved edges become several that follow them; lines stay on
/// the edges. Requires mid-nodes, and a quad per face.
std::vector<ShadedQuad> divide_curved(const HexMesh& mesh, const std::vector<VisibleFace>& faces,
                                      const std::vector<ShadedQuad>& quads, const Camera& camera);

}  // namespace hexwright
