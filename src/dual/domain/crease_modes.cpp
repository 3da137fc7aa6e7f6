// A fixed point over the convex creases: what is wrapped at one end is wrapped at the other, and a
// star in which some creases are wrapped may force its others. Creases only ever change from
// clipped to wrapped, so the passes end.
#include "dual/domain/crease_modes.h"

#include <algorithm>
#include <numeric>

namespace hexwright::dual {

namespace {

// A convex crease of one cell, seen from one of its two ends.
struct CreaseEnd {
  LatticeCoord cell;
  LatticeCoord low;  // low end of the root's edge
  int axis;
  std::size_t star;
  int bit;  // 1 << (2 * axis + side)
  auto key() const { return std::tuple{cell, low, axis}; }
};

std::vector<CreaseEnd> collect_ends(const std::vector<OctantStar>& stars) {
  std::vector<CreaseEnd> ends;
  for (std::size_t s = 0; s < stars.size(); ++s)
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        if (stars[s].num_around_edge(axis, side) != 1) continue;
        const int q = std::countr_zero(static_cast<unsigned>(stars[s].around_edge(axis, side)));
        CreaseEnd end{stars[s].vert, stars[s].vert, axis, s, 1 << (2 * axis + side)};
        for (int a = 0; a < 3; ++a) end.cell[a] -= !(q >> a & 1);
        end.low[axis] -= !side;
        ends.push_back(end);
      }
  std::sort(ends.begin(), ends.end(),
            [](const CreaseEnd& a, const CreaseEnd& b) { return a.key() < b.key(); });
  return ends;
}

// Must all creases at this star be wrapped, given those that are?
bool forces_wrap(const OctantStar& star, int num_wrapped) {
  switch (star.num_octants()) {
    case 1:
      return num_wrapped == 2;
    case 2:
    case 3:
      return num_wrapped >= 1;
    default:
      return true;  // five octants, tripod, chiral path: no clipped arrangement exists
  }
}

}  // namespace

std::vector<int> find_wrapped_creases(const std::vector<OctantStar>& stars) {
  const auto ends = collect_ends(stars);
  std::vector<int> convex(stars.size(), 0), wrapped(stars.size(), 0);
  for (const CreaseEnd& e : ends) convex[e.star] |= e.bit;
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::size_t s = 0; s < stars.size(); ++s) {
      const int num_wrapped = std::popcount(static_cast<unsigned>(wrapped[s]));
      if (wrapped[s] == convex[s] || !forces_wrap(stars[s], num_wrapped)) continue;
      wrapped[s] = convex[s];
      has_changed = true;
    }
    // Both ends of a crease agree. (Ends of one crease are consecutive.)
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      if (ends[i].key() != ends[i + 1].key()) continue;
      int &a = wrapped[ends[i].star], &b = wrapped[ends[i + 1].star];
      if (((a & ends[i].bit) != 0) == ((b & ends[i + 1].bit) != 0)) continue;
      a |= ends[i].bit;
      b |= ends[i + 1].bit;
      has_changed = true;
    }
  }
  return wrapped;
}

}  // namespace hexwright::dual
