#include "render/page/view_scene.h"

#include <algorithm>
#include <optional>

#include "hexwright/base/parallel.h"

#include "render/face_patches.h"

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

FaceMask bit_of(int lf) { return static_cast<FaceMask>(1U << lf); }

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
  const std::vector<PatchId> patches = find_face_patches(mesh);
  const auto patch_of = [&](const HexFace& face) {
    return patches.empty() ? PatchId() : patches[face_slot(face)];
  };
  scene.marked.assign(mesh.num_hexes(), 0);
  for (HexId h : mesh.hexes.ids())
    for (int lf = 0; lf < 6; ++lf)
      if (!scene.adjacency.neighbor[h][static_cast<std::size_t>(lf)].is_valid() ||
          patch_of({h, lf}).is_valid())
        scene.marked[h] = static_cast<FaceMask>(scene.marked[h] | bit_of(lf));
  const auto faces = find_marked_faces(scene);
  for (const HexFace& face : faces) scene.patch.push_back(patch_of(face));
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
