#include "render/curved_faces.h"

#include <algorithm>

namespace hexwright {
namespace {

constexpr int kDivisions = 4;  // of each side

// Light for a surface with this normal in the camera's frame: a key light from the upper left, a
// weaker one from the right. It is fixed to the eye and not to the scene, so that no view of a mesh
// is dark.
float light(const Vec3& normal) {
  const double key = std::max(0.0, dot(normal, normalized(Vec3{-0.45, 0.65, 0.65})));
  const double fill = std::max(0.0, dot(normal, normalized(Vec3{0.7, 0.1, 0.7})));
  return static_cast<float>(std::min(1.0, 0.62 + 0.30 * key + 0.2 * fill));
}

// Twice the area on the screen, negative when counter-clockwise as seen (y points down).
double signed_area(const std::array<ScreenPoint, 4>& c) {
  return (c[2].x - c[0].x) * (c[3].y - c[1].y) - (c[2].y - c[0].y) * (c[3].x - c[1].x);
}

bool is_curved(const QuadraticQuad& quad) {
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 &a = quad[k], &b = quad[(k + 1) % 4];
    if (norm_sq(quad[4 + k] - 0.5 * (a + b)) > 1e-12 * norm_sq(b - a)) return true;
  }
  return false;
}

// Sides that lie on those of the whole: k runs from corner k to k + 1, u along side 0.
std::uint8_t outer_sides(int i, int j) {
  const int last = kDivisions - 1;
  return static_cast<std::uint8_t>((j == 0 ? 1 : 0) | (i == last ? 2 : 0) | (j == last ? 4 : 0) |
                                   (i == 0 ? 8 : 0));
}

void append_parts(const QuadraticQuad& face, const ShadedQuad& whole, const Camera& camera,
                  std::vector<ShadedQuad>& parts) {
  const auto at = [&](int i, int j) {
    return point_on(face, double(i) / kDivisions, double(j) / kDivisions);
  };
  for (int j = 0; j < kDivisions; ++j)
    for (int i = 0; i < kDivisions; ++i) {
      ShadedQuad part = whole;
      light_quad({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, camera, part);
      part.line_sides = outer_sides(i, j);
      part.bold_sides = whole.bold_sides & part.line_sides;
      parts.push_back(part);
    }
}

}  // namespace

void light_quad(const std::array<Vec3, 4>& p, const Camera& camera, ShadedQuad& quad) {
  for (std::size_t k = 0; k < 4; ++k) quad.corners[k] = camera.project(p[k]);
  quad.is_back = signed_area(quad.corners) > 0;
  const Vec3 outward = normalized(cross(p[2] - p[0], p[3] - p[1]));
  quad.normal = camera.to_view(quad.is_back ? -outward : outward);
  quad.color = light(quad.normal) * quad.base_color;
}

std::vector<ShadedQuad> divide_curved(const HexMesh& mesh, const std::vector<VisibleFace>& faces,
                                      const std::vector<ShadedQuad>& quads, const Camera& camera) {
  std::vector<ShadedQuad> parts;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const HexFace& face = faces[i].face;
    const QuadraticQuad nodes = quadratic_face(quadratic_hex(mesh, face.hex), face.lf);
    if (is_curved(nodes))
      append_parts(nodes, quads[i], camera, parts);
    else
      parts.push_back(quads[i]);
  }
  return parts;
}

}  // namespace hexwright
