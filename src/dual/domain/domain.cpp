// Roots are kept in the same hashed sibling groups as split nodes, so that look-ups by lattice
// point cost the same at every depth.
#include "dual/domain/domain.h"

#include <algorithm>

namespace hexwright::dual {

Domain::Domain(const Grid& grid) : root_list_(grid.roots), finest_level_(grid.finest_level) {
  if (grid.roots.empty()) return;
  low_ = high_ = grid.roots.front();
  for (const LatticeCoord& root : grid.roots) {
    roots_.insert(root);
    for (int a = 0; a < 3; ++a) {
      low_[a] = std::min(low_[a], root[a]);
      high_[a] = std::max(high_[a], root[a] + 1);
    }
  }
  std::size_t volume = 1;
  for (int a = 0; a < 3; ++a) volume *= static_cast<std::size_t>(high_[a] - low_[a]);
  is_box_ = volume == grid.roots.size();
}

// A root without neighbour on both sides of an axis has two parallel boundary planes one edge
// apart.
bool Domain::is_thin() const {
  for (const LatticeCoord& root : root_list_)
    for (int a = 0; a < 3; ++a) {
      LatticeCoord below = root, above = root;
      --below[a];
      ++above[a];
      if (!contains_root(below) && !contains_root(above)) return true;
    }
  return false;
}

std::size_t Domain::cell_index(const LatticeCoord& root) const {
  const auto group = static_cast<std::size_t>(roots_.find_group(parent_of(root)));
  return 8 * group +
         static_cast<std::size_t>((root[0] & 1) | (root[1] & 1) << 1 | (root[2] & 1) << 2);
}

// Octant q of a point lies in the root whose finest-lattice cell has the point as the corner
// opposite to q: one step back on the axes where q is on the low side. The shift rounds down, also
// for negative coordinates.
int Domain::octants_at(const LatticeCoord& point) const {
  int octants = 0;
  for (int q = 0; q < 8; ++q) {
    LatticeCoord root;
    for (int a = 0; a < 3; ++a) root[a] = (point[a] - !(q >> a & 1)) >> finest_level_;
    if (contains_root(root)) octants |= 1 << q;
  }
  return octants;
}

// Octants joined by faces form a path of four when two of them have one neighbour and two have two
// (six ends of links in all). Four in a plane would be a ring of eight ends, so a path is always
// twisted out of any plane, left- or right-handed.
bool Domain::is_chiral_corner(const LatticeCoord& point) const {
  const int octants = octants_at(point);
  int num_octants = 0, num_ends = 0, num_links = 0;
  for (int q = 0; q < 8; ++q) {
    if (!(octants >> q & 1)) continue;
    int degree = 0;
    for (int a = 0; a < 3; ++a) degree += octants >> (q ^ 1 << a) & 1;
    ++num_octants;
    num_ends += degree == 1;
    num_links += degree;
  }
  return num_octants == 4 && num_ends == 2 && num_links == 6;
}

std::vector<LatticeCoord> Domain::find_chiral_corners() const {
  std::vector<LatticeCoord> corners;
  if (is_box_) return corners;
  // Found once from each of its four roots.
  for (const LatticeCoord& root : root_list_)
    for (int q = 0; q < 8; ++q) {
      const LatticeCoord corner = {root[0] + (q & 1), root[1] + (q >> 1 & 1), root[2] + (q >> 2)};
      LatticeCoord point = corner;
      for (auto& x : point) x *= root_edge();
      if (is_chiral_corner(point)) corners.push_back(corner);
    }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

// The boundary is flat where the domain covers exactly one side of a lattice plane.
bool Domain::is_corner_or_crease(const LatticeCoord& point) const {
  const int octants = octants_at(point);
  if (octants == 0 || octants == 0xFF) return false;
  for (const auto& sides : kSideMask)
    if (octants == sides[0] || octants == sides[1]) return false;
  return true;
}

}  // namespace hexwright::dual
