// The 48 poses, and the choice of one by shape alone.
#include "grid/pose.h"

#include <random>
#include <set>

#include <gtest/gtest.h>

#include "grid/grid_helpers.h"

namespace hexwright {
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
  const PosedDomain posed(domain, choose_pose(sets, domain, grid.finest_level), grid.finest_level);
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

}  // namespace
}  // namespace hexwright
