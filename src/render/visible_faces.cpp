// A cut removes whole hexes by their centres, which shows their real shapes; slicing through them
// would show polygons that are no faces of the mesh.
#include "render/visible_faces.h"

#include <algorithm>
#include <limits>

#include "hexwright/base/cancel.h"
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

// Pieces of what is kept, connected by faces: the piece of each hex and the hexes of each.
struct Pieces {
  IdVector<HexId, std::int32_t> piece;  // -1: not kept
  std::vector<std::size_t> size;
};
Pieces find_pieces(const HexNeighbors& adjacency, const IdVector<HexId, char>& is_kept) {
  Pieces pieces{IdVector<HexId, std::int32_t>(is_kept.size(), -1), {}};
  std::vector<HexId> reached;
  CancelCheck check_cancelled;
  for (HexId start : is_kept.ids()) {
    if (!is_kept[start] || pieces.piece[start] >= 0) continue;
    const auto piece = static_cast<std::int32_t>(pieces.size.size());
    pieces.size.push_back(0);
    pieces.piece[start] = piece;
    reached.assign(1, start);
    while (!reached.empty()) {
      check_cancelled();
      const HexId h = reached.back();
      reached.pop_back();
      ++pieces.size.back();
      for (HexId other : adjacency.neighbor[h]) {
        if (!other.is_valid() || !is_kept[other] || pieces.piece[other] >= 0) continue;
        pieces.piece[other] = piece;
        reached.push_back(other);
      }
    }
  }
  return pieces;
}

void remove_crumbs(const HexNeighbors& adjacency, IdVector<HexId, char>& is_kept) {
  const Pieces pieces = find_pieces(adjacency, is_kept);
  std::vector<char> is_crumb(pieces.size.size(), 1);
  std::size_t num_kept = 0;
  for (HexId h : is_kept.ids()) {
    if (!is_kept[h]) continue;
    ++num_kept;
    const auto& beyond = adjacency.neighbor[h];
    const bool touches_cut = std::any_of(beyond.begin(), beyond.end(), [&](HexId other) {
      return other.is_valid() && !is_kept[other];
    });
    if (!touches_cut) is_crumb[static_cast<std::size_t>(pieces.piece[h])] = 0;
  }
  for (HexId h : is_kept.ids()) {
    if (!is_kept[h]) continue;
    const auto piece = static_cast<std::size_t>(pieces.piece[h]);
    if (is_crumb[piece] && 20 * pieces.size[piece] <= num_kept) is_kept[h] = 0;
  }
}

std::vector<VisibleFace> list_faces(const HexNeighbors& adjacency,
                                    const IdVector<HexId, char>& is_kept) {
  std::vector<VisibleFace> faces;
  CancelCheck check_cancelled;
  for (HexId h : is_kept.ids()) {
    check_cancelled();
    if (!is_kept[h]) continue;
    for (int lf = 0; lf < 6; ++lf) {
      const HexId other = adjacency.neighbor[h][static_cast<std::size_t>(lf)];
      if (!other.is_valid() || !is_kept[other]) faces.push_back({{h, lf}, !other.is_valid()});
    }
  }
  return faces;
}

}  // namespace

std::vector<VisibleFace> find_visible_faces(const HexMesh& mesh,
                                            const std::optional<PictureOptions::Cut>& cut) {
  const HexNeighbors adjacency = compute_hex_neighbors(mesh);
  auto is_kept = find_kept(mesh, cut);
  if (cut) remove_crumbs(adjacency, is_kept);
  return list_faces(adjacency, is_kept);
}

std::vector<VisibleFace> find_faces_about(const HexMesh& mesh, HexId focus,
                                          const Vec3& view_direction) {
  constexpr int kNumSteps = 3;
  const VertToHex vert_to_hex(mesh);
  IdVector<HexId, char> is_kept(mesh.num_hexes(), 0);
  std::vector<HexId> around = {focus};
  is_kept[focus] = 1;
  for (int step = 0; step < kNumSteps; ++step)
    for (std::size_t i = 0, end = around.size(); i < end; ++i)
      for (VertId v : mesh.hexes[around[i]])
        for (const HexCorner& corner : vert_to_hex[v]) {
          if (is_kept[corner.hex]) continue;
          is_kept[corner.hex] = 1;
          around.push_back(corner.hex);
        }
  const Vec3 center = center_of(mesh.corners(focus));
  for (HexId h : around)
    if (h != focus && dot(center_of(mesh.corners(h)) - center, view_direction) < 0) is_kept[h] = 0;
  auto faces = list_faces(compute_hex_neighbors(mesh), is_kept);
  for (VisibleFace& face : faces) face.is_focus = face.face.hex == focus;
  return faces;
}

}  // namespace hexwright
