// Octants that meet at an edge or vertex only belong to different stars: each becomes a corner of
// the mesh of its own, which is how parts of the domain that touch there stay apart.
#include "dual/domain/octant_star.h"

#include <algorithm>

#include "hexwright/base/error.h"

namespace hexwright::dual {

namespace {

// Every corner of a root once, by z, then y, then x: this order numbers the base mesh's hexes.
std::vector<LatticeCoord> collect_lattice_verts(const Domain& domain) {
  std::vector<LatticeCoord> verts;
  verts.reserve(domain.roots().size() * 8);
  for (const LatticeCoord& root : domain.roots())
    for (int q = 0; q < 8; ++q)
      verts.push_back({root[0] + (q & 1), root[1] + (q >> 1 & 1), root[2] + (q >> 2)});
  std::sort(verts.begin(), verts.end(), [](const LatticeCoord& a, const LatticeCoord& b) {
    return std::array{a[2], a[1], a[0]} < std::array{b[2], b[1], b[0]};
  });
  verts.erase(std::unique(verts.begin(), verts.end()), verts.end());
  return verts;
}

// The face-connected part of `octants` that holds its lowest octant.
int connected_part(int octants) {
  int part = octants & -octants;
  for (int last = 0; last != part;) {
    last = part;
    for (int q = 0; q < 8; ++q)
      for (int a = 0; a < 3; ++a)
        if (part >> q & 1) part |= 1 << (q ^ 1 << a) & octants;
  }
  return part;
}

// Two octants left around an edge that are diagonal to each other touch along it only. In different
// stars they would be kept apart; in one star they are connected around the vertex, and no choice
// of vertices keeps the boundary a manifold.
void reject_pinched_edges(const OctantStar& star) {
  for (int a = 0; a < 3; ++a)
    for (int side = 0; side < 2; ++side) {
      const int around = star.around_edge(a, side);
      if (star.num_around_edge(a, side) != 2) continue;
      const int low = std::countr_zero(static_cast<unsigned>(around));
      if (!(around & ~(1 << low) & ~(1 << (low ^ 7 ^ 1 << a)))) {
        const LatticeCoord& v = star.vert;
        throw Error(ErrorCode::BadGeometry,
                    "the domain touches itself along a root's edge at lattice vertex (" +
                        std::to_string(v[0]) + ", " + std::to_string(v[1]) + ", " +
                        std::to_string(v[2]) + "); add or remove a root cube there");
      }
    }
}

}  // namespace

std::vector<OctantStar> collect_octant_stars(const Domain& domain) {
  std::vector<OctantStar> stars;
  const std::int32_t edge = domain.root_edge();
  for (const LatticeCoord& v : collect_lattice_verts(domain)) {
    int rest = domain.octants_at({v[0] * edge, v[1] * edge, v[2] * edge});
    while (rest) {
      const OctantStar star{v, connected_part(rest)};
      reject_pinched_edges(star);
      stars.push_back(star);
      rest &= ~star.mask;
    }
  }
  return stars;
}

}  // namespace hexwright::dual
