#include "render/creases.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/quad.h"

namespace hexwright {
namespace {

constexpr double kCosine = 0.766;  // of 40 degrees

using EdgeKey = std::array<VertId, 2>;
EdgeKey make_key(VertId a, VertId b) { return a < b ? EdgeKey{a, b} : EdgeKey{b, a}; }

struct Side {
  EdgeKey edge;
  std::size_t face = 0;
  unsigned k = 0;
  friend bool operator<(const Side& a, const Side& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.face < b.face;
  }
};

std::vector<Side> list_sides(const HexMesh& mesh, const std::vector<VisibleFace>& faces) {
  std::vector<Side> sides;
  sides.reserve(4 * faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto verts = face_verts(mesh, faces[i].face);
    for (unsigned k = 0; k < 4; ++k)
      sides.push_back({make_key(verts[k], verts[(k + 1) % 4]), i, k});
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

Vec3 normal_of(const HexMesh& mesh, const HexFace& face) {
  return quad_normal(mesh.positions, face_verts(mesh, face));
}

}  // namespace

void mark_creases(const HexMesh& mesh, std::vector<VisibleFace>& faces) {
  std::vector<EdgeKey> labeled;
  for (const LabeledEdge& edge : mesh.labels.edges)
    labeled.push_back(make_key(edge.verts[0], edge.verts[1]));
  std::sort(labeled.begin(), labeled.end());
  const auto is_crease = [&](const Side& a, const Side& b) {
    const VisibleFace &f = faces[a.face], &g = faces[b.face];
    if (f.is_boundary != g.is_boundary) return true;
    if (!f.is_boundary) return false;
    if (!labeled.empty()) return std::binary_search(labeled.begin(), labeled.end(), a.edge);
    return dot(normal_of(mesh, f.face), normal_of(mesh, g.face)) < kCosine;
  };
  // Three or more faces meet where parts touch: their pairs in order of the faces will do.
  const auto sides = list_sides(mesh, faces);
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &a = sides[i], &b = sides[i + 1];
    if (a.edge != b.edge || !is_crease(a, b)) continue;
    for (const Side& side : {a, b})
      faces[side.face].bold_sides =
          static_cast<std::uint8_t>(faces[side.face].bold_sides | 1U << side.k);
  }
}

}  // namespace hexwright
