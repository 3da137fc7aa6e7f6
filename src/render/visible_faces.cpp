// A cut removes whole hexes by their centres, which shows their real shapes; slicing through them
// would show polygons that are no faces of the mesh.
#include "render/visible_faces.h"

#include "hexwright/base/parallel.h"

namespace hexwright {
namespace {

Vec3 center_of(const std::array<Vec3, 8>& p) {
  Vec3 sum;
  for (const Vec3& x : p) sum += x;
  return sum / 8;
}

IdVector<HexId, char> find_kept(const HexMesh& mesh,
                                const std::optional<PictureOptions::Cut>& cut) {
  IdVector<HexId, char> is_kept(mesh.num_hexes(), 1);
  if (!cut) return is_kept;
  const Vec3 normal = normalized(cut->normal);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const auto& hex : mesh.hexes)
    for (VertId v : hex) {
      low = std::min(low, dot(mesh.positions[v], normal));
      high = std::max(high, dot(mesh.positions[v], normal));
    }
  // The plane's place is measured between the extremes of the used vertices along its normal.
  // The layer of a symmetric mesh that the plane halves has its centres on it but for noise: it
  // stays as a whole.
  constexpr double kNoise = 0.003;
  const double plane = low + (cut->offset + kNoise) * (high - low);
  parallel_for(mesh.num_hexes(), [&](std::size_t i) {
    is_kept[HexId(i)] = dot(center_of(mesh.corners(HexId(i))), normal) <= plane;
  });
  return is_kept;
}

}  // namespace

std::vector<VisibleFace> find_visible_faces(const HexMesh& mesh,
                                            const std::optional<PictureOptions::Cut>& cut) {
  const HexNeighbors adjacency = compute_hex_neighbors(mesh);
  const auto is_kept = find_kept(mesh, cut);
  std::vector<VisibleFace> faces;
  for (HexId h : mesh.hexes.ids()) {
    if (!is_kept[h]) continue;
    for (int lf = 0; lf < 6; ++lf) {
      const HexId other = adjacency.neighbor[h][static_cast<std::size_t>(lf)];
      if (!other.is_valid() || !is_kept[other]) faces.push_back({{h, lf}, !other.is_valid()});
    }
  }
  return faces;
}

}  // namespace hexwright
