// The union of root cubes, seen from every depth.
#include "grid/sets/lattice_domain.h"

#include <algorithm>

#include <fmt/format.h>

#include "hexwright/base/error.h"

namespace hexwright::grids {
namespace {

// Room for the neighbours of the outermost nodes: one brick at depth 0.
constexpr std::int32_t kRoom = 4;

}  // namespace

LatticeDomain::LatticeDomain(const std::vector<LatticeCoord>& roots, int finest_level)
    : roots_(roots) {
  for (int a = 0; a < 3; ++a) {
    const auto [lo, hi] = std::minmax_element(
        roots.begin(), roots.end(),
        [a](const LatticeCoord& p, const LatticeCoord& q) { return p[a] < q[a]; });
    const std::int32_t lowest_even = (*lo)[a] >> 1 << 1;
    shift_[a] = kRoom - lowest_even;
    const std::int64_t end = std::int64_t{(*hi)[a]} + 1 + shift_[a] + kRoom;
    if (end << std::max(0, finest_level - 1) > kMaxNodeCoord)
      throw Error(ErrorCode::OutOfResources,
                  fmt::format("roots spread over {} cubes cannot be split to level {}; use fewer "
                              "levels or split the domain",
                              (*hi)[a] - (*lo)[a] + 1, finest_level));
  }
  for (LatticeCoord& root : roots_)
    for (int a = 0; a < 3; ++a) root[a] += shift_[a];
  tabulate_roots();
}

LatticeCoord LatticeDomain::unshifted(const LatticeCoord& node, int depth) const {
  LatticeCoord out;
  for (int a = 0; a < 3; ++a) out[a] = node[a] - shift_[a] * (1 << depth);
  return out;
}

void LatticeDomain::tabulate_roots() {
  // Roots that lie far apart would need a huge table: those are searched instead.
  constexpr std::int64_t kMaxTable = 1 << 20;
  LatticeCoord hi = roots_.front();
  low_ = roots_.front();
  for (const LatticeCoord& root : roots_)
    for (int a = 0; a < 3; ++a) {
      low_[a] = std::min(low_[a], root[a]);
      hi[a] = std::max(hi[a], root[a]);
    }
  for (int a = 0; a < 3; ++a) size_[a] = static_cast<std::uint32_t>(hi[a] - low_[a] + 1);
  if (std::int64_t{size_[0]} * size_[1] * size_[2] > kMaxTable) return;
  is_root_.assign(std::size_t{size_[0]} * size_[1] * size_[2], 0);
  for (const LatticeCoord& root : roots_) is_root_[table_index(root)] = 1;
}

bool LatticeDomain::is_listed(const LatticeCoord& root) const {
  return std::binary_search(roots_.begin(), roots_.end(), root, root_less);
}

// From depth 2 on a brick lies inside one root; above, each of its nodes is asked.
BrickBits LatticeDomain::mask(BrickKey key, int depth) const {
  if (depth >= 2) return contains(node_of_bit(key, 0), depth) ? ~BrickBits{0} : 0;
  BrickBits bits = 0;
  for (int b = 0; b < 64; ++b)
    if (contains(node_of_bit(key, b), depth)) bits |= BrickBits{1} << b;
  return bits;
}

// Most bricks are well inside their root, which coordinates alone tell. The border of a domain of
// one root is the border of that root; between several roots the neighbours must be looked up.
bool LatticeDomain::is_interior(BrickKey key, int depth) const {
  if (depth >= 2) {
    const std::int32_t last = (1 << (depth - 2)) - 1;
    const LatticeCoord b = morton_decode(key);
    bool is_inside_root = true;
    for (int a = 0; a < 3; ++a) {
      const std::int32_t x = b[a] & last;
      is_inside_root = is_inside_root && x > 0 && x < last;
    }
    if (is_inside_root) return true;
    if (roots_.size() == 1) return false;
  }
  for (const BrickKey neighbour : neighbour_keys(key))
    if (mask(neighbour, depth) != ~BrickBits{0}) return false;
  return true;
}

}  // namespace hexwright::grids
