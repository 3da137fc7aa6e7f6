// Based on: docs/algorithms/dual.md, "The pillow stack". Invariant: after depth i every closed
// split node of depth i carries the complete 3x3x3 lattice of hexes, neighbours along each axis
// sharing a face.
#include "dual/pillows/pillow_stack.h"

#include <bit>

namespace hexwright::dual {

PillowStack::PillowStack(HexComplex& complex, const Domain& domain,
                         const std::vector<SplitNodes>& split)
    : complex_(complex), domain_(domain), split_(split), inserter_(complex) {}

void PillowStack::run(const Context& context) {
  for (HexId h : complex_.verts.ids()) active_.push_back({h, 0});
  const int num_depths = static_cast<int>(split_.size());
  for (int depth = 0; depth < num_depths; ++depth) {
    context.check_cancelled();
    activate_depth(depth);
    for (int axis = 0; axis < 3; ++axis) wrap_axis(axis);
    context.progress("dual", 0.5 * (depth + 1) / num_depths);
  }
}

// Split nodes are nested, so the hexes of this depth's nodes are among those of the last depth's.
void PillowStack::activate_depth(int depth) {
  depth_ = depth;
  spacing_ = domain_.root_edge() >> depth;
  std::vector<ActiveHex> active;
  for (const ActiveHex& h : active_) {
    const std::int32_t g = group_around(complex_.places[h.hex].point());
    if (g >= 0) active.push_back({h.hex, parity_of(g)});
  }
  active_ = std::move(active);
}

std::uint8_t PillowStack::parity_of(std::int32_t group) const {
  return split_[static_cast<std::size_t>(depth_)].groups()[static_cast<std::size_t>(group)].parity;
}

std::int32_t PillowStack::group_around(const LatticeCoord& p) const {
  const std::int32_t half = spacing_ / 2;
  return split_[static_cast<std::size_t>(depth_)].find_group_around(
      {p[0] / half, p[1] / half, p[2] / half});
}

void PillowStack::wrap_axis(int axis) {
  check_cancelled();
  core_.clear();
  for (const ActiveHex& h : active_)
    if (is_on_core_plane(h, axis)) core_.push_back(h.hex);
  if (core_.empty()) return;

  const HexId first = inserter_.insert(core_);
  CancelCheck check_cancelled;
  for (HexId h = first; h.index() < complex_.num_hexes(); ++h) {
    check_cancelled();
    const HexId inner = complex_.links[h][4].hex(), outer = complex_.links[h][5].hex();
    complex_.places[h] = place_layer_hex(inner, outer, axis);
    if (!complex_.places[h].is_lattice()) continue;
    const std::int32_t g = group_around(complex_.places[h].point());
    if (g >= 0) active_.push_back({h, parity_of(g)});
  }
}

bool PillowStack::is_on_plane(const LatticeCoord& p, int axis, int parity) const {
  return (p[axis] & (spacing_ - 1)) == 0 && ((p[axis] / spacing_) & 1) == (parity >> axis & 1);
}

bool PillowStack::is_on_core_plane(const ActiveHex& h, int axis) const {
  return is_on_plane(complex_.places[h.hex].point(), axis, h.parity);
}

// Between two lattice hexes one spacing apart along the pillow's axis the layer hex is the dual of
// the mid-plane's new lattice vertex; everywhere else it caps the pillow.
HexPlace PillowStack::place_layer_hex(HexId inner, HexId outer, int axis) const {
  const HexPlace &a = complex_.places[inner], &b = complex_.places[outer];
  if (!a.is_lattice() || !b.is_lattice()) return HexPlace::cap(inner, outer);
  int differing = 0;
  for (int k = 0; k < 3; ++k) differing |= (a.point()[k] != b.point()[k]) << k;
  if (differing == 1 << axis && std::abs(a.point()[axis] - b.point()[axis]) == spacing_) {
    LatticeCoord mid = a.point();
    mid[axis] = (mid[axis] + b.point()[axis]) / 2;
    return HexPlace::lattice(mid);
  }
  if (std::popcount(static_cast<unsigned>(differing)) == 2 && !domain_.is_box())
    return place_bent(inner, outer, axis, differing);
  return HexPlace::cap(inner, outer);
}

bool PillowStack::is_core_point(const LatticeCoord& p, int axis) const {
  const std::int32_t g = group_around(p);
  return g >= 0 && is_on_plane(p, axis, parity_of(g));
}

// Around a boundary vertex without hex of its own (some non-convex corners of the domain) hexes
// that differ on two axes are neighbours: the dual edge bends at that vertex. The layer hex goes
// where it would be if the edge were straight.
HexPlace PillowStack::place_bent(HexId inner, HexId outer, int axis, int differing) const {
  const LatticeCoord a = complex_.places[inner].point(), b = complex_.places[outer].point();
  int c = std::countr_zero(static_cast<unsigned>(differing));
  int d = std::countr_zero(static_cast<unsigned>(differing & (differing - 1)));
  if (d == axis) std::swap(c, d);
  LatticeCoord via_c = a, via_d = a;
  via_c[c] = b[c];
  via_d[d] = b[d];
  const bool bends_at_c = domain_.is_corner_or_crease(via_c);
  if (bends_at_c == domain_.is_corner_or_crease(via_d)) return HexPlace::cap(inner, outer);
  const bool is_crossing = c == axis && std::abs(a[axis] - b[axis]) == spacing_;
  if (is_crossing && (bends_at_c || is_core_point(via_d, axis))) {
    LatticeCoord mid = bends_at_c ? a : via_d;
    mid[c] = (a[c] + b[c]) / 2;
    return HexPlace::lattice(mid);
  }
  return HexPlace::cap(inner, outer, bends_at_c ? 1 << c : 1 << d);
}

}  // namespace hexwright::dual
