// Union-find over the few hexes around a vertex.
#include "fit/sheet_check.h"

#include <array>
#include <numeric>
#include <vector>

namespace hexwright::fitting {
namespace {

/// Faces at each local vertex.
constexpr std::array<std::array<int, 3>, 8> kFacesOfVertex = {{
    {0, 2, 4},
    {1, 2, 4},
    {1, 3, 4},
    {0, 3, 4},
    {0, 2, 5},
    {1, 2, 5},
    {1, 3, 5},
    {0, 3, 5},
}};

class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t k) { parent_[find(i)] = find(k); }

 private:
  std::vector<std::size_t> parent_;
};

/// Unit normal of a face at one of its vertices, out of the hex.
Vec3 corner_normal(const HexMesh& mesh, HexFace face, VertId v) {
  const auto quad = face_verts(mesh, face);
  std::size_t k = 0;
  while (quad[k] != v) ++k;
  const Vec3& o = mesh.positions[v];
  return normalized(
      cross(mesh.positions[quad[(k + 1) % 4]] - o, mesh.positions[quad[(k + 3) % 4]] - o));
}

}  // namespace

VertCheck SheetCheck::check(VertId v, std::span<const char> is_in_set) const {
  const auto star = vert_to_hex[v];
  const std::size_t n = star.size();
  UnionFind parts(n + 1);  // the last one is the outside
  std::vector<Vec3> normals;
  bool touches_outside = false;
  const auto is_in = [&](HexId h) { return is_in_set[h.index()] != 0; };
  for (std::size_t i = 0; i < n; ++i) {
    const HexId h = star[i].hex;
    for (int lf : kFacesOfVertex[static_cast<std::size_t>(star[i].lv)]) {
      const HexId other = neighbors.neighbor[h][static_cast<std::size_t>(lf)];
      const bool other_is_in = other.is_valid() && is_in(other);
      if (!other.is_valid() && counts_outside) {
        touches_outside = true;
        if (!is_in(h)) parts.join(i, n);
      }
      if (other.is_valid() && other < h && is_in(h) == other_is_in)
        for (std::size_t k = 0; k < i; ++k)
          if (star[k].hex == other) parts.join(i, k);
      const bool is_surface = is_in(h) && !other_is_in && (other.is_valid() || counts_outside);
      if (is_surface) normals.push_back(corner_normal(mesh, {h, lf}, v));
    }
  }
  VertCheck result;
  if (normals.empty()) return result;
  result.is_on_surface = true;
  constexpr std::size_t kNone = ~std::size_t{0};
  std::size_t root_in = kNone, root_out = touches_outside ? parts.find(n) : kNone;
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t& root = is_in(star[i].hex) ? root_in : root_out;
    if (root == kNone) root = parts.find(i);
    if (root != parts.find(i)) result.verdict = VertVerdict::NotManifold;
  }
  result.visible = find_sheet_direction(normals);
  if (result.verdict == VertVerdict::Good && result.visible.cosine < min_cosine)
    result.verdict = VertVerdict::NotVisible;
  return result;
}

}  // namespace hexwright::fitting
