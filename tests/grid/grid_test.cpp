#include "hexwright/grid/grid.h"

#include <random>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"

#include "grid/cells/morton.h"
#include "grid/grid_helpers.h"

namespace hexwright {

using namespace grids;

namespace {

using test::random_grid;
using test::specs_of;

const std::vector<LatticeCoord> kBentRoots = {{0, 0, 0}, {-1, 0, 0}, {-1, 1, 0}, {3, -2, 1}};

TEST(Morton, EncodesAndDecodesTheSameCoordinates) {
  std::mt19937 rng(1);
  for (int k = 0; k < 1000; ++k) {
    const LatticeCoord p = {std::int32_t(rng() % (1 << 20)), std::int32_t(rng() % (1 << 20)),
                            std::int32_t(rng() % (1 << 20))};
    EXPECT_EQ(morton_decode(morton_encode(p[0], p[1], p[2])), p);
  }
  EXPECT_EQ(morton_encode(1, 0, 0), 1u);
  EXPECT_EQ(morton_encode(0, 1, 0), 2u);
  EXPECT_EQ(morton_encode(0, 0, 1), 4u);
  EXPECT_EQ(morton_encode(2, 0, 0), 8u);
}

TEST(Grid, RootGridHasOneCell) {
  const Grid grid = make_root_grid({{1, 2, 3}, 4});
  EXPECT_FALSE(grid.find_problem());
  EXPECT_EQ(grid.num_cells(), 1u);
  EXPECT_EQ(cell_box(grid, CellId(0)).hi, (Vec3{5, 6, 7}));
}

TEST(Grid, SplittingKeepsATiling) {
  std::mt19937 rng(2);
  const Grid grid = random_grid(rng, kBentRoots, 4);
  ASSERT_FALSE(grid.find_problem()) << grid.find_problem()->message;
  double volume = 0;
  for (const CellId c : grid.cells.ids()) {
    const Vec3 e = cell_box(grid, c).extent();
    volume += e.x * e.y * e.z;
  }
  EXPECT_DOUBLE_EQ(volume, double(kBentRoots.size()));
}

TEST(Grid, MakeGridSortsShuffledCells) {
  std::mt19937 rng(3);
  const Grid grid = random_grid(rng, kBentRoots, 3);
  auto specs = specs_of(grid);
  std::shuffle(specs.begin(), specs.end(), rng);
  const Grid again = make_grid(grid.frame, kBentRoots, specs);
  EXPECT_EQ(again.cells, grid.cells);
  EXPECT_EQ(again.roots, grid.roots);
  EXPECT_EQ(again.finest_level, grid.finest_level);
}

TEST(Grid, MakeGridNamesTheFaultyCell) {
  std::mt19937 rng(4);
  const auto specs = specs_of(random_grid(rng, {{0, 0, 0}}, 3));
  const auto message_of = [](const std::vector<CellSpec>& cells) -> std::string {
    try {
      make_grid({}, {{0, 0, 0}}, cells);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::BadFile);
      return e.what();
    }
    return "";
  };
  for (int k = 0; k < 50; ++k) {
    auto broken = specs;
    const std::size_t victim = rng() % broken.size();
    broken.erase(broken.begin() + std::ptrdiff_t(victim));
    EXPECT_NE(message_of(broken).find("no cell covers"), std::string::npos);
    broken = specs;
    broken.push_back(broken[victim]);
    EXPECT_NE(message_of(broken).find("overlaps"), std::string::npos);
  }
  auto outside = specs;
  outside.push_back({1, {2, 0, 0}});
  EXPECT_NE(message_of(outside).find("(level 1, index 2 0 0)"), std::string::npos);
  outside.back() = {21, {0, 0, 0}};
  EXPECT_NE(message_of(outside).find("level"), std::string::npos);
  EXPECT_NE(message_of({}), "");
}

TEST(Grid, FindProblemSeesEveryCorruption) {
  std::mt19937 rng(5);
  const Grid good = random_grid(rng, kBentRoots, 3);
  for (int k = 0; k < 100; ++k) {
    Grid bad = good;
    GridCell& cell = bad.cells.raw()[rng() % bad.num_cells()];
    switch (k % 4) {
      case 0:
        cell.level = static_cast<std::int8_t>(cell.level + (cell.level ? -1 : 1));
        break;
      case 1:
        cell.corner[rng() % 3] += 1;
        break;
      case 2:
        std::swap(bad.cells.raw()[0], bad.cells.raw()[1 + rng() % (bad.num_cells() - 1)]);
        break;
      default:
        bad.finest_level += 1;
    }
    EXPECT_TRUE(bad.find_problem()) << k;
  }
  Grid no_frame = good;
  no_frame.frame.root_size = 0;
  EXPECT_TRUE(no_frame.find_problem());
}

TEST(Grid, DeepestLevelAndOutermostRootsFit) {
  Grid grid = make_grid({}, {{-1024, -1024, -1024}, {1023, 1023, 1023}},
                        {{0, {-1024, -1024, -1024}}, {0, {1023, 1023, 1023}}});
  for (int level = 0; level < kMaxGridLevel; ++level) {
    std::vector<char> marks(grid.num_cells(), 0);
    marks.front() = marks.back() = 1;
    grid = split_cells(grid, marks);
  }
  EXPECT_FALSE(grid.find_problem());
  EXPECT_EQ(count_cells_per_level(grid).back(), 16u);
  EXPECT_EQ(grid.cells.raw().back().corner[0], (1 << 30) - 1);
  EXPECT_THROW(split_cells(grid, std::vector<char>(grid.num_cells(), 1)), Error);
}

}  // namespace
}  // namespace hexwright
