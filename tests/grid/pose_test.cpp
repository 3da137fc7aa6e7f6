// The 48 poses, and the choice of one by shape alone.
#include "grid/sets/pose.h"

#include <random>
#include <set>

#include <gtest/gtest.h>

#include "grid/grid_helpers.h"

namespace hexwright {

using namespace grids;

namespace {

using test::random_grid;
using test::Roots;
using test::sample_domains;

/// The image of `grid` in a pose, with the roots where PosedDomain puts them before shifting.
Grid image_of(const Grid& grid, const Pose& pose) {
  Roots roots;
  const auto image = [&](const LatticeCoord& index) {
    LatticeCoord out;
    for (int a = 0; a < 3; ++a)
      out[a] = pose.flip[a] ? -1 - index[pose.axis[a]] : index[pose.axis[a]];
    return out;
  };
  for (const LatticeCoord& root : grid.roots) roots.push_back(image(root));
  auto specs = test::specs_of(grid);
  for (CellSpec& spec : specs) spec.index = image(spec.index);
  return make_grid(grid.frame, roots, specs);
}

NestedSets posed_sets(const Grid& grid) {
  const LatticeDomain domain(grid.roots, grid.finest_level);
  const NestedSets sets = split_sets_of(grid, domain);
  const PosedDomain posed(domain, choose_pose(sets, domain), grid.finest_level);
  NestedSets out;
  for (int d = 0; d < grid.finest_level; ++d) out.push_back(posed.to_posed(sets[d], d));
  return out;
}

TEST(Pose, ThereAreFortyEight) {
  std::set<LatticeCoord> images;
  for (int n = 0; n < 48; ++n) {
    const Pose pose = make_pose(n);
    LatticeCoord out;
    for (int a = 0; a < 3; ++a) out[a] = (pose.axis[a] + 1) * (pose.flip[a] ? -1 : 1);
    images.insert(out);
  }
  EXPECT_EQ(images.size(), 48u);
}

TEST(Pose, ThereAndBackIsTheIdentity) {
  std::mt19937 rng(1);
  for (const Roots& roots : sample_domains()) {
    const Grid grid = random_grid(rng, roots, 4);
    const LatticeDomain domain(grid.roots, grid.finest_level);
    const NestedSets sets = split_sets_of(grid, domain);
    for (int n = 0; n < 48; ++n) {
      const PosedDomain posed(domain, make_pose(n), grid.finest_level);
      for (int d = 0; d < grid.finest_level; ++d)
        EXPECT_EQ(posed.to_original(posed.to_posed(sets[d], d), d), sets[d]);
    }
  }
}

TEST(Pose, EveryImageOfAGridIsCompletedInTheSamePose) {
  std::mt19937 rng(2);
  int num_moved = 0;
  for (const Roots& roots : sample_domains()) {
    const Grid grid = random_grid(rng, roots, 4, 0.1);
    const NestedSets expected = posed_sets(grid);
    for (int n = 0; n < 48; ++n) {
      const Grid image = image_of(grid, make_pose(n));
      EXPECT_EQ(posed_sets(image), expected) << "pose " << n;
      num_moved += image.cells != grid.cells;
    }
  }
  EXPECT_GE(num_moved, 300);
}

TEST(Pose, SymmetricGridsKeepTheirs) {
  // Split towards the cube's middle: all 48 images are equal, so none is worth a transformation.
  Grid grid = test::unsplit_grid({{0, 0, 0}});
  for (int round = 0; round < 5; ++round) {
    std::vector<char> marks;
    const std::int32_t middle = 1 << (grid.finest_level - (round > 0));
    for (const CellId c : grid.cells.ids()) {
      bool touches = true;
      for (const std::int32_t x : grid.cells[c].corner)
        touches = touches && x <= middle && x + grid.cell_size(c) >= middle;
      marks.push_back(touches || round == 0);
    }
    grid = split_cells(grid, marks);
  }
  const LatticeDomain domain(grid.roots, grid.finest_level);
  EXPECT_TRUE(is_identity(choose_pose(split_sets_of(grid, domain), domain)));
}

TEST(Pose, TellsAGridFromItsMirrorImage) {
  // Three-fold symmetry without a mirror: sums over single axes cannot see the difference.
  std::mt19937 rng(3);
  int num_told = 0;
  for (int k = 0; k < 20; ++k) {
    test::PlainSets sets(3);
    sets[0] = {{0, 0, 0}};
    for (int q = 0; q < 8; ++q) sets[1].insert({q & 1, q >> 1 & 1, q >> 2});
    for (int n = 0; n < 3; ++n) {
      const auto x = static_cast<std::int32_t>(rng() % 4), y = static_cast<std::int32_t>(rng() % 4),
                 z = static_cast<std::int32_t>(rng() % 4);
      for (const LatticeCoord& c : {LatticeCoord{x, y, z}, {y, z, x}, {z, x, y}}) sets[2].insert(c);
    }
    const Grid grid = test::grid_of_plain_sets({{0, 0, 0}}, sets);
    Pose swap = make_pose(0);
    swap.axis = {1, 0, 2};
    const Grid image = image_of(grid, swap);
    EXPECT_EQ(posed_sets(image), posed_sets(grid));
    num_told += image.cells != grid.cells;
  }
  EXPECT_GT(num_told, 10);
}

}  // namespace
}  // namespace hexwright
