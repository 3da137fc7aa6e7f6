#include "fit/carve/set_check.h"

namespace hexwright::fitting {
namespace {

// One of the three faces at a local vertex, with the vertex's two neighbours in it, ordered so that
// their edges' cross product points out of the hex.
struct CornerFace {
  int lf = 0, next = 0, prev = 0;
};

std::array<std::array<CornerFace, 3>, 8> make_corner_faces() {
  std::array<std::array<CornerFace, 3>, 8> table{};
  std::array<std::size_t, 8> count{};
  for (std::size_t lf = 0; lf < 6; ++lf)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto lv = static_cast<std::size_t>(kHexFaces[lf][k]);
      table[lv][count[lv]++] = {static_cast<int>(lf), kHexFaces[lf][(k + 1) % 4],
                                kHexFaces[lf][(k + 3) % 4]};
    }
  return table;
}
const std::array<std::array<CornerFace, 3>, 8> kCornerFaces = make_corner_faces();

}  // namespace

int SetCheck::find(int x) {
  while (parent_[static_cast<std::size_t>(x)] != x) x = parent_[static_cast<std::size_t>(x)];
  return x;
}

void SetCheck::collect_normals(VertId v, const std::vector<char>& in_set) {
  normals_.clear();
  for (const HexCorner& corner : vert_to_hex_[v]) {
    if (!is_in(corner.hex, in_set)) continue;
    for (const CornerFace& face : kCornerFaces[static_cast<std::size_t>(corner.lv)]) {
      const HexId other = neighbors_.neighbor[corner.hex][static_cast<std::size_t>(face.lf)];
      if (other.is_valid() ? is_in(other, in_set) : !beyond_is_out_) continue;
      const auto& hex = mesh_.hexes[corner.hex];
      const Vec3& origin = mesh_.positions[v];
      const Vec3 a = mesh_.positions[hex[static_cast<std::size_t>(face.next)]] - origin;
      const Vec3 b = mesh_.positions[hex[static_cast<std::size_t>(face.prev)]] - origin;
      normals_.push_back(normalized(cross(a, b)));
    }
  }
}

// The hexes in the set and those out of it must each form one component under sharing a face at v.
bool SetCheck::is_connected(VertId v, const std::vector<char>& in_set) {
  const auto corners = vert_to_hex_[v];
  const int n = static_cast<int>(corners.size());
  parent_.resize(corners.size() + 1);
  for (int i = 0; i <= n; ++i) parent_[static_cast<std::size_t>(i)] = i;
  bool touches_beyond = false;
  for (int i = 0; i < n; ++i) {
    const HexCorner& corner = corners[static_cast<std::size_t>(i)];
    const bool in = is_in(corner.hex, in_set);
    for (const CornerFace& face : kCornerFaces[static_cast<std::size_t>(corner.lv)]) {
      const HexId other = neighbors_.neighbor[corner.hex][static_cast<std::size_t>(face.lf)];
      if (!other.is_valid()) {
        touches_beyond = true;
        if (!in && beyond_is_out_) parent_[static_cast<std::size_t>(find(i))] = find(n);
      } else if (other < corner.hex && is_in(other, in_set) == in) {
        int j = 0;  // corners are sorted by hex: the other one comes earlier
        while (corners[static_cast<std::size_t>(j)].hex != other) ++j;
        parent_[static_cast<std::size_t>(find(i))] = find(j);
      }
    }
  }
  int root[2] = {touches_beyond && beyond_is_out_ ? find(n) : -1, -1};
  for (int i = 0; i < n; ++i) {
    int& r = root[is_in(corners[static_cast<std::size_t>(i)].hex, in_set) ? 1 : 0];
    const int x = find(i);
    if (r < 0) r = x;
    if (r != x) return false;
  }
  return true;
}

SetFault SetCheck::check(VertId v, const std::vector<char>& in_set, double least_cosine) {
  bool any_in = false, any_out = false;
  for (const HexCorner& corner : vert_to_hex_[v])
    (is_in(corner.hex, in_set) ? any_in : any_out) = true;
  if (!any_in) return SetFault::None;
  if (!any_out && !beyond_is_out_) return SetFault::None;
  collect_normals(v, in_set);
  if (normals_.empty()) return SetFault::None;
  if (!is_connected(v, in_set)) return SetFault::NonManifold;
  if (find_visible_direction(normals_, least_cosine).cosine < least_cosine)
    return SetFault::NoVisibleDirection;
  return SetFault::None;
}

VisibleDirection SetCheck::direction(VertId v, const std::vector<char>& in_set) {
  collect_normals(v, in_set);
  if (normals_.empty()) return {};
  return find_visible_direction(normals_);
}

}  // namespace hexwright::fitting
