// The 48 symmetries of the cube, and the one in which a grid is completed.
//
// Images are told apart by hashes that are sums over nodes of a product of three random functions,
// one per axis of the image. Each function is split into its even and its odd part about the
// domain's centre, so that 48 sums over the nodes as they are give the hashes of all 48 images.
#include "grid/sets/pose.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "hexwright/base/parallel.h"

#include "grid/sets/hash.h"

namespace hexwright::grids {
namespace {

constexpr std::size_t kBricksPerChunk = 256;

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

constexpr int kNumPoses = 48, kNumSigns = 8;
constexpr std::array<std::array<int, 3>, 6> kAxes = {
    {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};

/// The word with two of its axes exchanged.
BrickBits swap_axes(BrickBits w, int a, int b) {
  BrickBits out = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const BrickBits part = w & slice(a, i) & slice(b, j);
      const int shift = (j - i) * (kAxisStep[a] - kAxisStep[b]);
      out |= shift >= 0 ? part << shift : part >> -shift;
    }
  return out;
}

BrickBits flip_axis(BrickBits w, int axis) {
  BrickBits out = 0;
  for (int i = 0; i < 4; ++i) out |= move_slice(w, axis, i, 3 - i);
  return out;
}

/// A symmetry of the lattice: mirrored axes first, then coordinate a becomes that of axis[a], then
/// a move.
struct LatticeMap {
  std::array<int, 3> axis;
  std::array<bool, 3> flip;  ///< by axis of the original
  LatticeCoord move;         ///< of the image, in nodes

  LatticeCoord operator()(const LatticeCoord& node) const {
    LatticeCoord out;
    for (int a = 0; a < 3; ++a) {
      const std::int32_t x = node[axis[a]];
      out[a] = (flip[axis[a]] ? -1 - x : x) + move[a];
    }
    return out;
  }
  /// Inside a brick, when the move is by whole bricks.
  BrickBits operator()(BrickBits w) const {
    for (int a = 0; a < 3; ++a)
      if (flip[a]) w = flip_axis(w, a);
    std::array<int, 3> at = {0, 1, 2};  // which original axis lies where now
    for (int a = 0; a < 3; ++a) {
      const int from = static_cast<int>(std::find(at.begin(), at.end(), axis[a]) - at.begin());
      if (from == a) continue;
      w = swap_axes(w, a, from);
      std::swap(at[a], at[from]);
    }
    return w;
  }
};

/// Whole bricks at once where the map keeps bricks together.
BrickSet map_bricks(const BrickSet& nodes, const LatticeMap& map) {
  std::vector<Brick> bricks(nodes.num_bricks());
  parallel_for(
      bricks.size(),
      [&](std::size_t i) {
        const Brick& b = nodes.bricks()[i];
        bricks[i] = {brick_of_node(map(node_of_bit(b.key, 0))), map(b.bits)};
      },
      kBricksPerChunk);
  return BrickSet(std::move(bricks));
}

BrickSet map_nodes(const BrickSet& nodes, const LatticeMap& map) {
  std::vector<Brick> bricks;
  for (const Brick& brick : nodes.bricks())
    for (BrickBits rest = brick.bits; rest != 0; rest &= rest - 1) {
      const LatticeCoord node = map(node_of_bit(brick.key, std::countr_zero(rest)));
      bricks.push_back({brick_of_node(node), BrickBits{1} << bit_of_node(node)});
    }
  return BrickSet(std::move(bricks));
}

BrickSet map_set(const BrickSet& nodes, const LatticeMap& map) {
  for (const std::int32_t x : map.move)
    if (x % 4 != 0) return map_nodes(nodes, map);
  return map_bricks(nodes, map);
}

/// Sums over nodes, by order of axes and by which of the three functions are odd parts.
using PoseSums = std::array<std::array<std::uint64_t, kNumSigns>, kAxes.size()>;

/// Even (0) and odd (1) part of the function of an image's axis, by twice the distance of a node's
/// middle from the centre.
std::uint64_t part_of_function(int image_axis, int odd, std::int64_t twice_distance) {
  if (odd && twice_distance == 0) return 0;
  const auto size = static_cast<std::uint64_t>(std::abs(twice_distance));
  const std::uint64_t value = mix_bits(6 * size + static_cast<std::uint64_t>(2 * image_axis + odd));
  return odd && twice_distance < 0 ? ~value + 1 : value;
}

/// Both parts of the functions of all image axes at the coordinates of a brick along one own axis.
using AxisValues = std::array<std::array<std::array<std::uint64_t, 2>, 3>, 4>;  // coord, image, odd

AxisValues axis_values(std::int32_t first, std::int32_t twice_centre) {
  AxisValues out;
  for (int c = 0; c < 4; ++c)
    for (int image = 0; image < 3; ++image)
      for (int odd = 0; odd < 2; ++odd)
        out[c][image][odd] =
            part_of_function(image, odd, 2 * std::int64_t{first + c} + 1 - twice_centre);
  return out;
}

/// Image axes of the own axes x, y and z, per order of axes: the inverse of kAxes.
constexpr auto kImageOf = [] {
  std::array<std::array<int, 3>, kAxes.size()> out{};
  for (std::size_t k = 0; k < kAxes.size(); ++k)
    for (int image = 0; image < 3; ++image) out[k][kAxes[k][image]] = image;
  return out;
}();

/// Adds up nodes by whole bricks. The products are summed row by row and plane by plane, so that a
/// node costs six additions and the multiplications are per row and plane.
class PoseSummer {
 public:
  explicit PoseSummer(const LatticeCoord& twice_centre) : twice_centre_(twice_centre) {}

  void add(const Brick& brick) {
    const LatticeCoord first = node_of_bit(brick.key, 0);
    for (int a = 0; a < 3; ++a) {
      if (first[a] == first_[a]) continue;  // consecutive bricks mostly share coordinates
      first_[a] = first[a];
      value_[a] = axis_values(first[a], twice_centre_[a]);
    }
    for (int z = 0; z < 4; ++z)
      if (const auto bits = static_cast<unsigned>(brick.bits >> 16 * z & 0xffff))
        add_plane(bits, z);
  }
  const PoseSums& sums() const { return sums_; }

 private:
  void add_plane(unsigned bits, int z) {
    std::array<std::array<std::uint64_t, 4>, kAxes.size()> plane{};  // by signs of x and y
    for (int y = 0; y < 4; ++y)
      if (const unsigned row_bits = bits >> 4 * y & 0xf) add_row(row_bits, y, plane);
    for (std::size_t k = 0; k < kAxes.size(); ++k) {
      const auto [i, j, l] = kImageOf[k];
      for (int s = 0; s < kNumSigns; ++s)
        sums_[k][(s & 1) << i | (s >> 1 & 1) << j | (s >> 2) << l] +=
            plane[k][s & 3] * value_[2][z][l][s >> 2];
    }
  }

  void add_row(unsigned bits, int y,
               std::array<std::array<std::uint64_t, 4>, kAxes.size()>& plane) const {
    std::array<std::array<std::uint64_t, 2>, 3> row{};
    for (; bits != 0; bits &= bits - 1) {
      const auto& value = value_[0][std::countr_zero(bits)];
      for (int i = 0; i < 3; ++i)
        for (int odd = 0; odd < 2; ++odd) row[i][odd] += value[i][odd];
    }
    for (std::size_t k = 0; k < kAxes.size(); ++k)
      for (int s = 0; s < 4; ++s)
        plane[k][s] += row[kImageOf[k][0]][s & 1] * value_[1][y][kImageOf[k][1]][s >> 1];
  }

  LatticeCoord twice_centre_;
  LatticeCoord first_ = {-1, -1, -1};  ///< where value_ begins
  std::array<AxisValues, 3> value_{};
  PoseSums sums_{};
};

PoseSums combined(PoseSums a, const PoseSums& b) {
  for (std::size_t k = 0; k < a.size(); ++k)
    for (int s = 0; s < kNumSigns; ++s) a[k][s] += b[k][s];
  return a;
}

/// Hash of the image in a pose: mirroring an axis changes the sign of its odd part.
std::uint64_t pose_hash(const PoseSums& sums, int pose) {
  std::uint64_t hash = 0;
  for (int s = 0; s < kNumSigns; ++s) {
    const std::uint64_t sum = sums[static_cast<std::size_t>(pose / 8)][s];
    hash += std::popcount(static_cast<unsigned>(s & pose & 7)) & 1 ? ~sum + 1 : sum;
  }
  return hash;
}

PoseSums sums_of(const BrickSet& set, const LatticeCoord& twice_centre) {
  return parallel_reduce(
      set.num_bricks(), PoseSums{},
      [&](std::size_t begin, std::size_t end) {
        PoseSummer summer(twice_centre);
        for (const Brick& b : set.bricks().subspan(begin, end - begin)) summer.add(b);
        return summer.sums();
      },
      combined, kBricksPerChunk);
}

/// Keeps the candidates of least hash.
void keep_first(const PoseSums& sums, std::vector<int>& candidates) {
  std::uint64_t least = ~std::uint64_t{0};
  for (const int n : candidates) least = std::min(least, pose_hash(sums, n));
  std::erase_if(candidates, [&](int n) { return pose_hash(sums, n) != least; });
}

}  // namespace

Pose make_pose(int number) {
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
  LatticeMap map{pose_.axis, {}, {}};
  for (int a = 0; a < 3; ++a) {
    map.flip[pose_.axis[a]] = pose_.flip[a];
    map.move[a] = offset_[a] * (1 << depth);
  }
  return map_set(nodes, map);
}

BrickSet PosedDomain::to_original(const BrickSet& nodes, int depth) const {
  LatticeMap map{{}, pose_.flip, {}};
  for (int a = 0; a < 3; ++a) {
    map.axis[pose_.axis[a]] = a;
    // x = +-(y - move), and -1 - (y - move) = (-1 - y) + move.
    map.move[pose_.axis[a]] = (pose_.flip[a] ? 1 : -1) * offset_[a] * (1 << depth);
  }
  return map_set(nodes, map);
}

Pose choose_pose(const NestedSets& sets, const LatticeDomain& domain) {
  LatticeCoord low = domain.shifted_roots().front(), high = low;
  for (const LatticeCoord& root : domain.shifted_roots())
    for (int a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], root[a]);
      high[a] = std::max(high[a], root[a]);
    }
  std::vector<int> candidates(kNumPoses);
  std::iota(candidates.begin(), candidates.end(), 0);
  const auto twice_centre = [&](int depth) {
    LatticeCoord out;
    for (int a = 0; a < 3; ++a) out[a] = (low[a] + high[a] + 1) * (1 << depth);
    return out;
  };
  PoseSummer roots(twice_centre(0));
  for (const LatticeCoord& root : domain.shifted_roots())
    roots.add({brick_of_node(root), BrickBits{1} << bit_of_node(root)});
  keep_first(roots.sums(), candidates);
  for (int d = 0; d < static_cast<int>(sets.size()) && candidates.size() > 1; ++d)
    keep_first(sums_of(sets[static_cast<std::size_t>(d)], twice_centre(d)), candidates);
  return make_pose(candidates.front());
}

}  // namespace hexwright::grids
