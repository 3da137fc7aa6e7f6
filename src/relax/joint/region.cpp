#include "relax/joint/region.h"

#include <algorithm>

namespace hexwright::relax {

JointRegion::JointRegion(const FitState& state, std::vector<VertId> movable,
                         std::vector<HexId> hexes)
    : hexes_(std::move(hexes)) {
  number_verts(state, movable);
  find_corners();
  find_edges(state);
}

void JointRegion::number_verts(const FitState& state, const std::vector<VertId>& movable) {
  shape_.num_movable = movable.size();
  std::vector<VertId> all;
  for (HexId h : hexes_)
    all.insert(all.end(), state.mesh.hexes[h].begin(), state.mesh.hexes[h].end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());

  const auto rank = [&](VertId v) {
    return static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), v) - all.begin());
  };
  constexpr LocalVert kNone = 0xffff;
  std::vector<LocalVert> number(all.size(), kNone);
  verts_ = movable;
  for (std::size_t i = 0; i < movable.size(); ++i)
    number[rank(movable[i])] = static_cast<LocalVert>(i);
  for (std::size_t r = 0; r < all.size(); ++r) {
    if (number[r] != kNone) continue;
    number[r] = static_cast<LocalVert>(verts_.size());
    verts_.push_back(all[r]);
  }
  for (HexId h : hexes_) {
    std::array<LocalVert, 8>& local = local_hexes_.emplace_back();
    for (std::size_t lv = 0; lv < 8; ++lv) local[lv] = number[rank(state.mesh.hexes[h][lv])];
  }
}

void JointRegion::find_corners() {
  for (const auto& hex : local_hexes_) {
    for (std::size_t lv = 0; lv < 8; ++lv) {
      const auto& n = kHexCornerNeighbors[lv];
      const LocalCorner corner = {hex[lv], hex[static_cast<std::size_t>(n[0])],
                                  hex[static_cast<std::size_t>(n[1])],
                                  hex[static_cast<std::size_t>(n[2])]};
      if (std::any_of(corner.begin(), corner.end(), [&](LocalVert v) { return is_movable(v); }))
        shape_.corners.push_back(corner);
    }
  }
}

void JointRegion::find_edges(const FitState& state) {
  std::vector<std::array<LocalVert, 2>> edges;
  for (const LocalCorner& c : shape_.corners)
    for (std::size_t k = 1; k < 4; ++k)
      if (is_movable(std::min(c[0], c[k])))
        edges.push_back({std::min(c[0], c[k]), std::max(c[0], c[k])});
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& e : edges)
    shape_.edges.push_back({e, 0.5 * (state.size[verts_[e[0]]] + state.size[verts_[e[1]]])});
}

}  // namespace hexwright::relax
