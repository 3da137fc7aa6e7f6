// Looks at each boundary quad without a label.
#include "pipeline/loop/outer_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "hexwright/mesh/hex_adjacency.h"

#include "mesh/quad.h"

namespace hexwright {
namespace {

constexpr std::array<const char*, 6> kSideNames = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};

/// The side of the box that all vertices lie on; -1 = none.
int find_side(const HexMesh& mesh, const std::array<VertId, 4>& quad, const Box3& box) {
  const double room = 1e-9 * box.diagonal();
  for (int side = 0; side < 6; ++side) {
    const double at = side % 2 == 0 ? box.lo[side / 2] : box.hi[side / 2];
    if (std::all_of(quad.begin(), quad.end(),
                    [&](VertId v) { return std::abs(mesh.positions[v][side / 2] - at) <= room; }))
      return side;
  }
  return -1;
}

}  // namespace

Box3 box_of(const GridDomain& domain) {
  Box3 box;
  for (const LatticeCoord& root : domain.roots)
    for (int end : {0, 1}) {
      Vec3 p = domain.frame.origin;
      for (int a = 0; a < 3; ++a)
        p[a] += (root[static_cast<std::size_t>(a)] + end) * domain.frame.root_edge(a);
      box.extend(p);
    }
  return box;
}

void name_outer_faces(const Box3& box, HexMesh& mesh) {
  BoundaryLabels& labels = mesh.labels;
  std::set<std::array<VertId, 4>> labelled;
  std::int32_t num_patches = static_cast<std::int32_t>(labels.patch_names.size());
  for (const LabeledQuad& quad : labels.quads) {
    labelled.insert(sorted(quad.verts));
    num_patches = std::max(num_patches, quad.patch.value() + 1);
  }
  std::array<bool, 6> is_used{};
  for (const HexFace& face : compute_hex_neighbors(mesh).boundary) {
    const auto quad = face_verts(mesh, face);
    const int side = find_side(mesh, quad, box);
    if (side < 0 || labelled.contains(sorted(quad))) continue;
    labels.quads.push_back({quad, PatchId(num_patches + side)});
    is_used[static_cast<std::size_t>(side)] = true;
  }
  labels.patch_names.resize(static_cast<std::size_t>(num_patches) + 6);
  for (std::size_t side = 0; side < 6; ++side)
    if (is_used[side])
      labels.patch_names[PatchId(static_cast<std::size_t>(num_patches) + side)] = kSideNames[side];
}

}  // namespace hexwright
