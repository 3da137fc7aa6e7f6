// The checks find what is wrong, and name it.
#include <random>

#include <gtest/gtest.h>

#include "hexwright/grid/complete.h"

#include "grid/grid_helpers.h"
#include "grid/pairing/clusters.h"

namespace hexwright {

using namespace grids;

namespace {

using test::plain_split_sets;
using test::PlainSets;
using test::random_grid;
using test::Roots;
using test::sample_domains;

/// Balance by its definition: every neighbour of a split node exists.
bool is_balanced_slowly(const Grid& grid, Balance balance) {
  const PlainSets sets = plain_split_sets(grid);
  const std::set<LatticeCoord> roots(grid.roots.begin(), grid.roots.end());
  const int reach = balance == Balance::Relaxed ? 2 : 1;  // levels that neighbours may differ by
  for (std::size_t d = static_cast<std::size_t>(reach); d < sets.size(); ++d)
    for (const LatticeCoord& c : sets[d])
      for (int n = 0; n < 27; ++n) {
        const LatticeCoord step = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
        const int moved = std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]);
        if (balance == Balance::Weak && moved > 1) continue;
        const LatticeCoord q = {c[0] + step[0], c[1] + step[1], c[2] + step[2]};
        const int depth = static_cast<int>(d);
        if (!roots.count({q[0] >> depth, q[1] >> depth, q[2] >> depth})) continue;
        if (!sets[d - reach].count({q[0] >> reach, q[1] >> reach, q[2] >> reach})) return false;
      }
  return true;
}

/// Exhaustive search for a conflict-free set of blocks that covers exactly the split nodes.
class BlockSearch {
 public:
  BlockSearch(const std::set<LatticeCoord>& split, const std::set<LatticeCoord>& roots, int depth)
      : split_(split), roots_(roots), depth_(depth) {}
  bool exists() {
    const LatticeCoord* open = nullptr;
    for (const LatticeCoord& c : split_)
      if (!covered_.count(c)) {
        open = &c;
        break;
      }
    if (!open) return true;
    for (int q = 0; q < 8; ++q)
      if (try_block({(*open)[0] + (q & 1), (*open)[1] + (q >> 1 & 1), (*open)[2] + (q >> 2)}))
        return true;
    return false;
  }

 private:
  bool try_block(const LatticeCoord& v) {
    for (const LatticeCoord& w : centers_)
      if (is_block_conflict({v[0] - w[0], v[1] - w[1], v[2] - w[2]})) return false;
    std::vector<LatticeCoord> added;
    for (int q = 0; q < 8; ++q) {
      const LatticeCoord c = {v[0] - (q & 1), v[1] - (q >> 1 & 1), v[2] - (q >> 2)};
      if (!roots_.count({c[0] >> depth_, c[1] >> depth_, c[2] >> depth_})) continue;
      if (!split_.count(c)) return false;
      added.push_back(c);
    }
    const auto before = covered_;
    covered_.insert(added.begin(), added.end());
    centers_.push_back(v);
    if (exists()) return true;
    centers_.pop_back();
    covered_ = before;
    return false;
  }

  const std::set<LatticeCoord>& split_;
  const std::set<LatticeCoord>& roots_;
  int depth_;
  std::set<LatticeCoord> covered_;
  std::vector<LatticeCoord> centers_;
};

bool is_paired_slowly(const Grid& grid) {
  const PlainSets sets = plain_split_sets(grid);
  const std::set<LatticeCoord> roots(grid.roots.begin(), grid.roots.end());
  for (std::size_t d = 0; d < sets.size(); ++d)
    if (!BlockSearch(sets[d], roots, static_cast<int>(d)).exists()) return false;
  return true;
}

TEST(FindUnbalanced, AgreesWithTheDefinition) {
  std::mt19937 rng(1);
  int num_balanced = 0, num_checked = 0;
  for (int k = 0; k < 40; ++k)
    for (const Roots& roots : sample_domains()) {
      Grid grid = random_grid(rng, roots, 2 + k % 3, 0.02 + 0.1 * (k % 10));
      if (k % 4 == 0) grid = complete(grid, {Balance::Weak, Pairing::None, true}, {}).grid;
      for (const Balance balance : {Balance::Relaxed, Balance::Weak, Balance::Strong}) {
        const bool expected = is_balanced_slowly(grid, balance);
        EXPECT_EQ(!find_unbalanced(grid, balance), expected);
        num_balanced += expected;
        ++num_checked;
      }
    }
  EXPECT_GT(num_balanced, num_checked / 10);
  EXPECT_LT(num_balanced, num_checked * 9 / 10);
}

TEST(FindUnpaired, AgreesWithExhaustiveSearch) {
  std::mt19937 rng(2);
  int num_paired = 0, num_checked = 0;
  for (int k = 0; k < 60; ++k)
    for (const Roots& roots : sample_domains()) {
      Grid grid = random_grid(rng, roots, 2, 0.05);
      grid = complete(grid, {Balance::Weak, Pairing::Blocks, true}, {}).grid;
      if (k % 2) {  // split one more node, which may or may not stay paired
        std::vector<char> marks(grid.num_cells(), 0);
        marks[rng() % marks.size()] = 1;
        grid = split_cells(grid, marks);
      }
      const bool expected = is_paired_slowly(grid);
      EXPECT_EQ(!find_unpaired(grid), expected);
      num_paired += expected;
      ++num_checked;
    }
  EXPECT_LT(num_paired, num_checked);
  EXPECT_GE(num_paired, num_checked / 2);
}

/// Depth-2 nodes of one root cube that are split, everything above them too.
Grid grid_with_blocks(const std::vector<LatticeCoord>& centers, int depth) {
  PlainSets sets(static_cast<std::size_t>(depth) + 1);
  for (int d = 0; d < depth; ++d)
    for (int i = 0; i < 1 << (3 * d); ++i)
      sets[static_cast<std::size_t>(d)].insert(
          {i & ((1 << d) - 1), i >> d & ((1 << d) - 1), i >> (2 * d)});
  for (const LatticeCoord& v : centers)
    for (int q = 0; q < 8; ++q)
      sets[static_cast<std::size_t>(depth)].insert(
          {v[0] - (q & 1), v[1] - (q >> 1 & 1), v[2] - (q >> 2)});
  return test::grid_of_plain_sets({{0, 0, 0}}, sets);
}

TEST(FindUnpaired, FollowsTheRuleForTwoBlocks) {
  // One block at (3,3,3) of an 8^3 lattice and a second at every offset.
  for (int dx = 0; dx <= 4; ++dx)
    for (int dy = 0; dy <= 4; ++dy)
      for (int dz = 0; dz <= 4; ++dz) {
        const LatticeCoord second = {3 + dx, 3 + dy, 3 + dz};
        const bool conflict = is_block_conflict({dx, dy, dz});
        const bool is_paired = !find_unpaired(grid_with_blocks({{3, 3, 3}, second}, 3));
        EXPECT_EQ(is_paired, !conflict) << dx << dy << dz;
      }
}

TEST(FindUnpaired, AcceptsGroupsTooLargeForExactSearch) {
  // Single split nodes scattered so densely that nearly all of them depend on each other.
  std::mt19937 rng(3);
  PlainSets sets = plain_split_sets(grid_with_blocks({}, 5));
  sets.resize(6);
  for (int k = 0; k < 400; ++k)
    sets[5].insert({std::int32_t(rng() % 32), std::int32_t(rng() % 32), std::int32_t(rng() % 32)});
  const Grid grid = test::grid_of_plain_sets({{0, 0, 0}}, sets);
  const CompleteResult result = complete(grid, {Balance::Weak, Pairing::Blocks, true}, {});
  EXPECT_GT(result.report.largest_group, 50u);
  const auto issue = find_unpaired(result.grid);
  EXPECT_FALSE(issue) << issue->message;
}

TEST(FindUnpaired, NamesTheMissingNode) {
  PlainSets sets = plain_split_sets(grid_with_blocks({{3, 3, 3}}, 3));
  sets[3].erase({3, 3, 3});
  const auto issue = find_unpaired(test::grid_of_plain_sets({{0, 0, 0}}, sets));
  ASSERT_TRUE(issue);
  EXPECT_NE(issue->message.find("(level 3, index 3 3 3) is not split"), std::string::npos)
      << issue->message;
}

TEST(FindUnbalanced, NamesTheCoarseCellAndItsFineNeighbour) {
  Grid grid = split_cells(make_root_grid({}), {1});
  grid = split_cells(grid, {1, 0, 0, 0, 0, 0, 0, 0});
  std::vector<char> marks(grid.num_cells(), 0);
  marks[1] = 1;  // level 2, index 1 0 0: touches the level-1 cell 1 0 0
  const auto issue = find_unbalanced(split_cells(grid, marks), Balance::Weak);
  ASSERT_TRUE(issue);
  EXPECT_NE(issue->message.find("cell (level 1, index 1 0 0)"), std::string::npos)
      << issue->message;
  EXPECT_NE(issue->message.find("node (level 2, index 1 0 0)"), std::string::npos);
}

/// Coarsening by its definition: some node split in the input is not split in the grid.
bool is_coarsened_slowly(const Grid& grid, const Grid& input) {
  const PlainSets sets = plain_split_sets(grid), needed = plain_split_sets(input);
  for (std::size_t d = 0; d < needed.size(); ++d)
    for (const LatticeCoord& c : needed[d])
      if (d >= sets.size() || !sets[d].count(c)) return true;
  return false;
}

TEST(FindCoarsened, AgreesWithTheDefinition) {
  std::mt19937 rng(5);
  int num_coarsened = 0, num_checked = 0;
  for (int k = 0; k < 30; ++k)
    for (const Roots& roots : sample_domains()) {
      const Grid input = random_grid(rng, roots, 1 + k % 3, 0.05);
      const Grid grid = k % 3 == 0   ? complete(input, {}, {}).grid
                        : k % 3 == 1 ? random_grid(rng, roots, 3, 0.9)
                                     : random_grid(rng, roots, 1 + k % 2, 0.05);
      const bool expected = is_coarsened_slowly(grid, input);
      EXPECT_EQ(find_coarsened(grid, input).has_value(), expected);
      EXPECT_FALSE(k % 3 == 0 && expected) << "completed";
      num_coarsened += expected;
      ++num_checked;
    }
  EXPECT_GT(num_coarsened, num_checked / 5);
}

TEST(FindCoarsened, NamesTheCellAndRefusesOtherDomains) {
  const Grid root = make_root_grid({});
  const Grid fine = split_cells(split_cells(root, {1}), {0, 0, 0, 1, 0, 0, 0, 0});
  const auto issue = find_coarsened(split_cells(root, {1}), fine);
  ASSERT_TRUE(issue);
  EXPECT_NE(issue->message.find("cell (level 1, index 1 1 0)"), std::string::npos)
      << issue->message;
  EXPECT_FALSE(find_coarsened(fine, split_cells(root, {1})));
  EXPECT_TRUE(find_coarsened(test::unsplit_grid({{0, 0, 0}, {1, 0, 0}}), root));
  EXPECT_TRUE(find_coarsened(make_root_grid({{1, 0, 0}, 1}), root)) << "another place";
}

TEST(BlockConflict, CountsThePapersExclusions) {
  int touching = 0, gap_one = 0;
  for (int dx = -4; dx <= 4; ++dx)
    for (int dy = -4; dy <= 4; ++dy)
      for (int dz = -4; dz <= 4; ++dz)
        if (is_block_conflict({dx, dy, dz})) {
          const int far = std::max({std::abs(dx), std::abs(dy), std::abs(dz)});
          ++(far <= 2 ? touching : gap_one);
        }
  EXPECT_EQ(touching, 98);
  EXPECT_EQ(gap_one, 210);
}

}  // namespace
}  // namespace hexwright
