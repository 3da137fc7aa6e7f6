#include "render/page/view_scene.h"

#include <algorithm>
#include <optional>

#include "hexwright/base/parallel.h"

namespace hexwright {
namespace {

// Layer by layer inwards. Hexes that no boundary face leads to keep 255.
IdVector<HexId, std::uint8_t> find_depths(const HexNeighbors& adjacency) {
  constexpr std::uint8_t kDeepest = 255;
  IdVector<HexId, std::uint8_t> depth(adjacency.neighbor.size(), kDeepest);
  std::vector<HexId> layer, next;
  const auto reach = [&](HexId h, std::uint8_t value) {
    if (depth[h] != kDeepest) return;
    depth[h] = value;
    next.push_back(h);
  };
  for (const HexFace& face : adjacency.boundary) reach(face.hex, 0);
  for (const HexFace& face : adjacency.non_conforming) reach(face.hex, 0);
  for (std::uint8_t d = 1; d < kDeepest && !next.empty(); ++d) {
    layer.swap(next);
    next.clear();
    for (HexId h : layer)
      for (HexId other : adjacency.neighbor[h])
        if (other.is_valid()) reach(other, d);
  }
  return depth;
}

std::array<VertId, 4> sorted(std::array<VertId, 4> quad) {
  std::sort(quad.begin(), quad.end());
  return quad;
}

// Patches by (hex, lf): 6 per hex.
using FacePatches = std::vector<PatchId>;
FaceMask bit_of(int lf) { return static_cast<FaceMask>(1U << lf); }
std::size_t slot_of(const HexFace& face) {
  return 6 * face.hex.index() + static_cast<std::size_t>(face.lf);
}

// A labelled quad lies on one face of the boundary, or on the two of an interface.
void mark_labels(const HexMesh& mesh, ViewScene& scene, FacePatches& patches) {
  if (mesh.labels.quads.empty()) return;
  const VertToHex vert_to_hex(mesh);
  for (const LabeledQuad& quad : mesh.labels.quads) {
    const auto wanted = sorted(quad.verts);
    for (const HexCorner& corner : vert_to_hex[quad.verts[0]])
      for (int lf = 0; lf < 6; ++lf) {
        const HexFace face{corner.hex, lf};
        if (sorted(face_verts(mesh, face)) != wanted) continue;
        scene.marked[face.hex] = static_cast<FaceMask>(scene.marked[face.hex] | bit_of(lf));
        patches[slot_of(face)] = quad.patch;
      }
  }
}

std::vector<HexFace> find_marked_faces(const ViewScene& scene) {
  std::vector<HexFace> faces;
  for (HexId h : scene.marked.ids())
    for (int lf = 0; lf < 6; ++lf)
      if ((scene.marked[h] & bit_of(lf)) != 0) faces.push_back({h, lf});
  return faces;
}

// The largest of a face's corners and centre: it is between the corners that a face leaves a curved
// surface.
double face_distance(const HexMesh& mesh, const HexFace& face, const SurfaceTree& surface) {
  Vec3 sum;
  double largest = 0;
  for (VertId v : face_verts(mesh, face)) {
    sum += mesh.positions[v];
    largest = std::max(largest, surface.distance(mesh.positions[v]));
  }
  return std::max(largest, surface.distance(sum / 4));
}

}  // namespace

ViewScene make_view_scene(const HexMesh& mesh, const ViewOptions& options) {
  ViewScene scene;
  scene.adjacency = compute_hex_neighbors(mesh);
  scene.scaled_jacobian = compute_scaled_jacobians(mesh);
  scene.depth = find_depths(scene.adjacency);
  scene.marked.assign(mesh.num_hexes(), 0);
  for (HexId h : mesh.hexes.ids())
    for (int lf = 0; lf < 6; ++lf)
      if (!scene.adjacency.neighbor[h][static_cast<std::size_t>(lf)].is_valid())
        scene.marked[h] = static_cast<FaceMask>(scene.marked[h] | bit_of(lf));
  FacePatches patches(6 * mesh.num_hexes());
  mark_labels(mesh, scene, patches);
  const auto faces = find_marked_faces(scene);
  for (const HexFace& face : faces) scene.patch.push_back(patches[slot_of(face)]);
  if (options.surface) {
    scene.distance.resize(faces.size());
    parallel_for(
        faces.size(),
        [&](std::size_t i) {
          scene.distance[i] = static_cast<float>(face_distance(mesh, faces[i], *options.surface));
        },
        64);
  }
  scene.sample =
      choose_view_sample(mesh, scene.adjacency, scene.scaled_jacobian, options.max_whole_hexes);
  return scene;
}

}  // namespace hexwright
