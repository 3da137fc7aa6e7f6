// The 48 symmetries of the cube, and the one in which a grid is completed.
#include "grid/pose.h"

#include <algorithm>

#include "grid/hash.h"

namespace hexwright {
namespace {

// Bricks that choose_pose may transform before it stops looking deeper.
constexpr std::size_t kMaxWork = 200'000;

/// Image of a root, before the move to zero.
LatticeCoord root_image(const LatticeCoord& root, const Pose& pose) {
  LatticeCoord out;
  for (int a = 0; a < 3; ++a) {
    const std::int32_t x = root[pose.axis[a]];
    out[a] = pose.flip[a] ? -1 - x : x;
  }
  return out;
}

std::vector<LatticeCoord> root_images(const std::vector<LatticeCoord>& roots, const Pose& pose,
                                      std::array<std::int32_t, 3>& offset) {
  std::vector<LatticeCoord> out;
  for (const LatticeCoord& root : roots) out.push_back(root_image(root, pose));
  for (int a = 0; a < 3; ++a) {
    offset[a] = -(*std::min_element(out.begin(), out.end(),
                                    [a](const auto& p, const auto& q) { return p[a] < q[a]; }))[a];
    for (LatticeCoord& root : out) root[a] += offset[a];
  }
  std::sort(out.begin(), out.end(), root_less);
  return out;
}

/// Applies `image` to every node.
template <class Image>
BrickSet map_nodes(const BrickSet& nodes, Image&& image) {
  std::vector<Brick> bricks;
  bricks.reserve(nodes.num_bricks());
  for (const Brick& brick : nodes.bricks())
    for (BrickBits rest = brick.bits; rest != 0; rest &= rest - 1) {
      const LatticeCoord node = image(node_of_bit(brick.key, std::countr_zero(rest)));
      const BrickKey key = brick_of_node(node);
      if (bricks.empty() || bricks.back().key != key) bricks.push_back({key, 0});
      bricks.back().bits |= BrickBits{1} << bit_of_node(node);
    }
  return BrickSet(std::move(bricks));
}

}  // namespace

Pose make_pose(int number) {
  constexpr std::array<std::array<int, 3>, 6> kAxes = {
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  Pose pose;
  pose.axis = kAxes[number / 8];
  for (int a = 0; a < 3; ++a) pose.flip[a] = number >> a & 1;
  return pose;
}

PosedDomain::PosedDomain(const LatticeDomain& original, const Pose& pose, int finest_level)
    : pose_(pose), domain_(root_images(original.shifted_roots(), pose, offset_), finest_level) {
  for (int a = 0; a < 3; ++a) offset_[a] += domain_.shift()[a];
}

BrickSet PosedDomain::to_posed(const BrickSet& nodes, int depth) const {
  return map_nodes(nodes, [&](const LatticeCoord& node) {
    LatticeCoord out = root_image(node, pose_);
    for (int a = 0; a < 3; ++a) out[a] += offset_[a] * (1 << depth);
    return out;
  });
}

BrickSet PosedDomain::to_original(const BrickSet& nodes, int depth) const {
  return map_nodes(nodes, [&](const LatticeCoord& node) {
    LatticeCoord out;
    for (int a = 0; a < 3; ++a) {
      const std::int32_t x = node[a] - offset_[a] * (1 << depth);
      out[pose_.axis[a]] = pose_.flip[a] ? -1 - x : x;
    }
    return out;
  });
}

Pose choose_pose(const NestedSets& sets, const LatticeDomain& domain, int finest_level) {
  std::vector<int> candidates(48);
  for (int n = 0; n < 48; ++n) candidates[n] = n;
  std::size_t work = 0;
  for (int d = 0; d < static_cast<int>(sets.size()) && candidates.size() > 1; ++d) {
    work += candidates.size() * sets[d].num_bricks();
    if (work > kMaxWork) break;
    std::vector<std::uint64_t> hashes;
    for (const int n : candidates) {
      const PosedDomain posed(domain, make_pose(n), finest_level);
      hashes.push_back(
          hash_of(posed.to_posed(sets[d], d), hash_of(posed.domain().shifted_roots())));
    }
    const std::uint64_t least = *std::min_element(hashes.begin(), hashes.end());
    std::vector<int> kept;
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (hashes[i] == least) kept.push_back(candidates[i]);
    candidates = std::move(kept);
  }
  return make_pose(candidates.front());
}

}  // namespace hexwright
