// The table of options: names, defaults, and what is refused.
#include "hexwright/pipeline/option_table.h"

#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/pipeline/report.h"

namespace hexwright {
namespace {

/// All tables, each of a struct of its own that lives as long.
struct AllTables {
  MeshOptions mesh, grid, inspect;
  CompleteOptions complete;
  DualStageOptions dual;
  FitStageOptions fit;
  ImproveOptions improve;
  PolycubeOptions polycube;
  FeatureOptions features;
  EvaluateOptions evaluate = default_evaluate_options();
  std::vector<OptionTable> tables = {
      make_option_table(mesh),           make_grid_option_table(grid), make_option_table(complete),
      make_option_table(dual),           make_option_table(fit),       make_option_table(improve),
      make_option_table(polycube),       make_option_table(features),  make_option_table(evaluate),
      make_inspect_option_table(inspect)};
};

TEST(OptionTable, NamesAreUniqueAndEveryRowIsExplained) {
  for (const OptionTable& table : AllTables().tables) {
    std::set<std::string> names;
    for (const NamedOption& row : table) {
      EXPECT_TRUE(names.insert(row.name).second) << row.name;
      EXPECT_FALSE(row.help.empty() || row.help.back() == '.') << row.name;
      EXPECT_FALSE(row.fallback.empty()) << row.name;
    }
  }
}

TEST(OptionTable, EveryDefaultIsAValueThatItsOptionTakes) {
  AllTables all;
  for (const OptionTable& table : all.tables)
    for (const NamedOption& row : table) {
      const bool is_value = row.fallback != "the tolerance" && row.fallback != "none" &&
                            row.fallback != "twice the tolerance";
      if (!is_value) continue;
      EXPECT_NO_THROW(row.set(row.fallback)) << row.name;
    }
  MeshOptions untouched;
  untouched.loop_extra_levels = 0;  // a level that is given, even the default, binds the loop
  untouched.is_tolerance_given = true;
  EXPECT_EQ(mesh_options_to_json(all.mesh), mesh_options_to_json(untouched));
}

TEST(OptionTable, EveryOptionRefusesNonsenseAndThenChangesNothing) {
  AllTables all;
  const std::string before = mesh_options_to_json(all.mesh);
  for (const OptionTable& table : all.tables)
    for (const NamedOption& row : table)
      for (const char* text : {"nonsense", "", "-7", "nan", "1e400", "3x", " 1", "0x1", "%"})
        EXPECT_THROW(row.set(text), Error) << row.name << " = " << text;
  EXPECT_EQ(mesh_options_to_json(all.mesh), before);
}

TEST(OptionTable, SetsWhatItNames) {
  MeshOptions options;
  const OptionTable table = make_option_table(options);
  find_option(table, "max-level")->set("6");
  find_option(table, "tolerance")->set("0.2%");
  find_option(table, "side")->set("both");
  find_option(table, "feature-angle")->set("30");
  find_option(table, "no-loop")->set("true");
  EXPECT_EQ(options.sizing.max_level, 6);
  EXPECT_EQ(options.loop_extra_levels, 0);
  EXPECT_DOUBLE_EQ(options.sizing.tolerance, 0.002);
  EXPECT_EQ(options.fit.carve.side, Side::Both);
  EXPECT_DOUBLE_EQ(options.target.features.crease_angle, std::numbers::pi / 6);
  EXPECT_EQ(options.max_rounds, 0);
  EXPECT_EQ(find_option(table, "no-such-option"), nullptr);
}

TEST(OptionTable, SharesAreWrittenAsPercentOrFraction) {
  EXPECT_DOUBLE_EQ(parse_share("0.5%"), 0.005);
  EXPECT_DOUBLE_EQ(parse_share("0.005"), 0.005);
  EXPECT_EQ(share_to_text(0.005), "0.5%");
  EXPECT_THROW(parse_share("5"), Error);  // a forgotten percent sign
  EXPECT_THROW(parse_share("0"), Error);
}

}  // namespace
}  // namespace hexwright
