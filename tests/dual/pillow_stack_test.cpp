// The invariants that the pillow stack's proof rests on (docs/algorithms/dual.md, "Why the result
// conforms"), hex by hex.
#include "dual/pillows/pillow_stack.h"

#include <map>

#include <gtest/gtest.h>

#include "hexwright/dual/dual_mesh.h"

#include "dual/build_complex.h"
#include "dual/dual_helpers.h"
#include "dual/random_grids.h"

namespace hexwright::dual {
namespace {

struct Built {
  Grid grid;
  HexComplex complex;
  std::map<LatticeCoord, HexId> hex_at;  ///< lattice hexes by place, in finest units
};

Built build(const Grid& grid, DualMode mode) {
  Built out;
  out.complex = build_complex(grid, mode, {}, out.grid);
  for (const HexId h : out.complex.places.ids()) {
    const HexPlace& place = out.complex.places[h];
    if (place.is_lattice()) {
      EXPECT_TRUE(out.hex_at.emplace(place.point(), h).second) << "two hexes at one lattice vertex";
    }
  }
  return out;
}

/// Paired boxes and balanced ones by sheets.
std::vector<Built> sample() {
  std::vector<Built> out;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const auto roots = test::random_box(seed);
    out.push_back(build(test::random_paired_tree(seed, roots).grid(), DualMode::Blocks));
    out.push_back(build(test::random_balanced_tree(seed, roots).grid(), DualMode::Sheets));
    out.push_back(build(test::random_unbalanced_tree(seed, roots).grid(), DualMode::Sheets));
  }
  return out;
}

bool share_face(const HexComplex& complex, HexId a, HexId b) {
  for (const FaceLink& link : complex.links[a])
    if (!link.is_plane() && link.hex() == b) return true;
  return false;
}

TEST(PillowStack, LinksAreSound) {
  for (const Built& b : sample()) {
    const auto issue = b.complex.find_problem();
    EXPECT_FALSE(issue) << issue->message;
  }
}

TEST(PillowStack, EverySplitNodeCarriesItsLatticeOfHexes) {
  std::size_t num_nodes = 0;
  for (const Built& b : sample()) {
    const auto split = collect_split_nodes(b.grid);
    for (std::size_t depth = 0; depth < split.size(); ++depth) {
      const std::int32_t half = (1 << b.grid.finest_level >> depth) / 2;
      for (const NodeGroup& group : split[depth].groups())
        for (int child = 0; child < 8; ++child) {
          if (!(group.children >> child & 1)) continue;
          ++num_nodes;
          const auto hex_of = [&](const LatticeCoord& step) {
            LatticeCoord p;
            for (int a = 0; a < 3; ++a)
              p[a] = (2 * (2 * group.parent[a] + (child >> a & 1)) + step[a]) * half;
            const auto found = b.hex_at.find(p);
            return found == b.hex_at.end() ? HexId() : found->second;
          };
          for (int q = 0; q < 27; ++q) {
            const LatticeCoord step = {q % 3, q / 3 % 3, q / 9};
            const HexId here = hex_of(step);
            ASSERT_GE(here.value(), 0) << "a lattice vertex of a split node has no hex";
            for (int a = 0; a < 3; ++a) {
              // Pillows of finer depths come between the hexes of coarser ones.
              if (step[a] == 2 || depth + 1 < split.size()) continue;
              LatticeCoord next = step;
              ++next[a];
              EXPECT_TRUE(share_face(b.complex, here, hex_of(next))) << "axis " << a;
            }
          }
        }
    }
  }
  EXPECT_GT(num_nodes, 100u);
}

TEST(PillowStack, CapsLieBetweenOlderHexes) {
  std::size_t num_caps = 0;
  for (const Built& b : sample())
    for (const HexId h : b.complex.places.ids()) {
      const HexPlace& place = b.complex.places[h];
      if (place.is_lattice()) continue;
      ++num_caps;
      EXPECT_LT(place.inner(), h);
      EXPECT_LT(place.outer(), h);
      EXPECT_NE(place.inner(), place.outer());
    }
  EXPECT_GT(num_caps, 100u);
}

TEST(PillowStack, BorderFacesLieOnTheBoxAndNowhereElse) {
  for (const Built& b : sample()) {
    ASSERT_EQ(b.complex.planes.size(), 6u);
    for (const auto& [place, hex] : b.hex_at)
      for (const FaceLink& link : b.complex.links[hex]) {
        if (!link.is_plane()) continue;
        const DomainPlane& plane = b.complex.planes[static_cast<std::size_t>(link.plane())];
        EXPECT_EQ(place[plane.axis], plane.coord);
      }
  }
}

}  // namespace
}  // namespace hexwright::dual
