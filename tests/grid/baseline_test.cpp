// Leaf counts on the shared baseline grids against the reference's.
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "hexwright/grid/complete.h"

#include "grid/grid_helpers.h"
#include "helpers.h"

namespace hexwright {
namespace {

struct BaselineRow {
  std::string name;
  Grid grid;
  std::map<std::string, std::size_t> leaves;  ///< by column of the reference
};

Grid read_cells(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<CellSpec> cells;
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    CellSpec spec;
    if (fields >> spec.level >> spec.index[0] >> spec.index[1] >> spec.index[2])
      cells.push_back(spec);
  }
  return make_grid({}, {{0, 0, 0}}, cells);
}

std::vector<BaselineRow> read_baseline() {
  const auto dir = test::shared_dir() / "baseline";
  std::ifstream file(dir / "reference.csv");
  const auto fields_of = [](const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    return fields;
  };
  std::string line;
  std::getline(file, line);
  const auto header = fields_of(line);
  std::vector<BaselineRow> rows;
  while (std::getline(file, line)) {
    const auto fields = fields_of(line);
    BaselineRow row{fields.at(0), read_cells(dir / "grids" / (fields.at(0) + ".cells")), {}};
    for (std::size_t i = 2; i < 7; ++i) row.leaves[header.at(i)] = std::stoul(fields.at(i));
    rows.push_back(std::move(row));
  }
  return rows;
}

TEST(Baseline, OctreePairingReproducesTheReferenceExactly) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  const auto rows = read_baseline();
  ASSERT_EQ(rows.size(), 30u);
  for (const BaselineRow& row : rows) {
    EXPECT_EQ(row.grid.num_cells(), row.leaves.at("input_leaves"));
    for (const auto& [balance, column] :
         {std::pair{Balance::Weak, "op_weak"}, std::pair{Balance::Strong, "op_strong"}})
      EXPECT_EQ(complete(row.grid, {balance, Pairing::Octree, true}, {}).grid.num_cells(),
                row.leaves.at(column))
          << row.name;
  }
}

TEST(Baseline, BlocksNeverNeedMoreCellsThanTheReference) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  for (const auto& [balance, column, share] : {std::tuple{Balance::Weak, "gp_weak", 0.983},
                                               std::tuple{Balance::Strong, "gp_strong", 0.987}}) {
    std::size_t ours = 0, theirs = 0;
    for (const BaselineRow& row : read_baseline()) {
      const CompleteResult result = complete(row.grid, {balance, Pairing::Blocks, true}, {});
      EXPECT_LE(result.grid.num_cells(), row.leaves.at(column)) << row.name << " " << column;
      EXPECT_TRUE(result.report.is_optimal_per_depth) << row.name;
      const auto unpaired = find_unpaired(result.grid);
      EXPECT_FALSE(unpaired) << row.name << ": " << unpaired->message;
      EXPECT_FALSE(find_unbalanced(result.grid, balance)) << row.name;
      ours += result.grid.num_cells();
      theirs += row.leaves.at(column);
    }
    EXPECT_LT(static_cast<double>(ours), share * static_cast<double>(theirs)) << column;
  }
}

TEST(Baseline, CountIsTheSameInMirroredAndTurnedPoses) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  // Grids whose ties, broken by position, come out differently in different poses.
  int num_checked = 0;
  for (const BaselineRow& row : read_baseline()) {
    if (row.grid.num_cells() > 10'000) continue;
    std::vector<CellSpec> specs = test::specs_of(row.grid);
    for (CellSpec& spec : specs) {
      const auto [x, y, z] = spec.index;
      spec.index = {(1 << spec.level) - 1 - z, x, y};
    }
    const Grid turned = make_grid({}, {{0, 0, 0}}, specs);
    for (const Balance balance : {Balance::Weak, Balance::Strong})
      EXPECT_EQ(complete(turned, {balance, Pairing::Blocks, true}, {}).grid.num_cells(),
                complete(row.grid, {balance, Pairing::Blocks, true}, {}).grid.num_cells())
          << row.name;
    ++num_checked;
  }
  EXPECT_GE(num_checked, 20);
}

TEST(Baseline, DescentPaysOnTheReferenceGrids) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  std::size_t with = 0, without = 0;
  for (const BaselineRow& row : read_baseline()) {
    const std::size_t swept =
        complete(row.grid, {Balance::Strong, Pairing::Blocks, false}, {}).grid.num_cells();
    const std::size_t improved =
        complete(row.grid, {Balance::Strong, Pairing::Blocks, true}, {}).grid.num_cells();
    EXPECT_LE(improved, swept) << row.name;
    with += improved;
    without += swept;
  }
  EXPECT_LT(static_cast<double>(with), 0.995 * static_cast<double>(without));
}

}  // namespace
}  // namespace hexwright
