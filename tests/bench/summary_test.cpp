// Statistics and comparison of evaluations, on records made by hand.
#include "bench/summary.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "bench/compare.h"

namespace hexwright::cli {
namespace {

/// A record with these numbers of cells; two hexes per cell, a microsecond per input cell.
Json make_record(const std::string& name, double input, const std::vector<double>& cells) {
  Json record = {{"schema", 1}, {"model", name}, {"status", "done"}, {"input", {{"cells", input}}}};
  const char* keys[] = {"octree_strong", "octree_weak", "blocks", "sheets"};
  for (std::size_t m = 0; m < cells.size(); ++m)
    record["methods"][keys[m]] = {{"cells", cells[m]},
                                  {"growth", cells[m] - input},
                                  {"relative_growth", cells[m] / input - 1},
                                  {"seconds", input * 1e-6},
                                  {"dual_seconds", input * 3e-6},
                                  {"hexes", 2 * cells[m]}};
  record["mesh"] = {
      {"valid", true},
      {"hexes", 1000},
      {"seconds", 2.0},
      {"verdict",
       {{"quality", {{"inverted", 0}, {"min_scaled_jacobian", 0.3}, {"avg_scaled_jacobian", 0.8}}},
        {"distance", {{"max", 0.004}}},
        {"features", {{"length_share", 0.95}}}}}};
  return record;
}

std::vector<Json> two_models() {
  return {make_record("a", 100, {400, 300, 200, 120}),
          make_record("b", 1000, {2000, 2000, 2000, 1100})};
}

TEST(BenchSummary, Table1IsAveragesAndMaxima) {
  const Json s = summarize(two_models());
  EXPECT_EQ(s["compared"], 2);
  EXPECT_EQ(s["input"]["avg"], 550.0);
  EXPECT_EQ(s["input"]["max"], 1000.0);
  const Json& strong = s["methods"]["octree_strong"];
  EXPECT_EQ(strong["growth"]["avg"], 650.0);
  EXPECT_EQ(strong["growth"]["max"], 1000.0);
  EXPECT_EQ(strong["relative_growth"]["avg"], 2.0);
  EXPECT_EQ(strong["factor"]["avg"], 3.0);
  EXPECT_EQ(strong["factor"]["max"], 4.0);
  EXPECT_NEAR(s["methods"]["sheets"]["hexes_per_blocks"]["avg"].get<double>(), (0.6 + 0.55) / 2,
              1e-12);
}

TEST(BenchSummary, SharesCountWhatIsReachedExactly) {
  const Json s = summarize(two_models());
  EXPECT_EQ(s["methods"]["octree_strong"]["at_least"]["2"], 1.0);
  EXPECT_EQ(s["methods"]["octree_strong"]["at_least"]["3"], 0.5);
  EXPECT_EQ(s["methods"]["octree_strong"]["at_least"]["4"], 0.5);
  EXPECT_EQ(s["methods"]["blocks"]["at_least"]["2"], 1.0);
  EXPECT_EQ(s["methods"]["blocks"]["at_least"]["3"], 0.0);
}

TEST(BenchSummary, SpeedAndSlopeComeFromTheTimes) {
  const Json time = summarize(two_models())["methods"]["blocks"]["time"];
  EXPECT_NEAR(time["alone"]["cells_per_second"].get<double>(), 1e6, 1);
  EXPECT_NEAR(time["with_dual"]["cells_per_second"].get<double>(), 2.5e5, 1);
  EXPECT_NEAR(time["alone"]["exponent"].get<double>(), 1, 1e-9);
}

TEST(BenchSummary, AgreementIsOfOctreesAndBlocks) {
  const Json agree = summarize(two_models())["agree"];
  ASSERT_EQ(agree.size(), 1u);
  EXPECT_EQ(agree[0], "b");
}

TEST(BenchSummary, AModelWithoutEveryMethodIsLeftOutOfTable1) {
  std::vector<Json> records = two_models();
  records[1]["methods"].erase("sheets");
  records.push_back({{"model", "c"}, {"status", "failed"}, {"message", "broken"}});
  const Json s = summarize(records);
  EXPECT_EQ(s["models"], 3);
  EXPECT_EQ(s["compared"], 1);
  EXPECT_EQ(s["input"]["avg"], 100.0);
  EXPECT_EQ(s["meshes"]["made"], 2);
}

TEST(BenchSummary, NothingToSummarizeIsNoFault) {
  const Json s = summarize({});
  EXPECT_EQ(s["compared"], 0);
  EXPECT_FALSE(summary_to_text(s).empty());
}

TEST(BenchSummary, PowerLawsAreFound) {
  std::vector<double> x, y;
  for (int k = 1; k < 20; ++k) {
    x.push_back(10.0 * k);
    y.push_back(0.25 * std::pow(10.0 * k, 1.5));
  }
  const PowerLaw law = fit_power_law(x, y);
  EXPECT_NEAR(law.exponent, 1.5, 1e-12);
  EXPECT_NEAR(law.factor, 0.25, 1e-12);
  EXPECT_EQ(fit_power_law({5, 5}, {1, 2}).exponent, 0);
  EXPECT_EQ(fit_power_law({}, {}).factor, 0);
}

TEST(BenchSummary, MedianOfEvenAndOddCounts) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_EQ(median({}), 0);
}

/// Regressions after changing one figure of the second model.
std::vector<std::string> regressions(const std::string& path, const Json& value,
                                     const CompareTolerances& tolerances = {}) {
  std::vector<Json> after = two_models();
  after[1][Json::json_pointer(path)] = value;
  return compare_results(two_models(), after, tolerances).regressions;
}

TEST(BenchCompare, EqualResultsAreNoRegression) {
  EXPECT_TRUE(compare_results(two_models(), two_models(), {}).regressions.empty());
}

TEST(BenchCompare, TolerancesAreTheLimit) {
  EXPECT_TRUE(regressions("/methods/blocks/cells", 2039).empty());
  EXPECT_EQ(regressions("/methods/blocks/cells", 2041).size(), 1u);
  EXPECT_TRUE(regressions("/methods/blocks/cells", 100).empty());
  EXPECT_TRUE(regressions("/mesh/verdict/quality/min_scaled_jacobian", 0.26).empty());
  EXPECT_EQ(regressions("/mesh/verdict/quality/min_scaled_jacobian", 0.24).size(), 1u);
  EXPECT_TRUE(regressions("/mesh/verdict/distance/max", 0.0043).empty());
  EXPECT_EQ(regressions("/mesh/verdict/distance/max", 0.0045).size(), 1u);
  EXPECT_EQ(regressions("/mesh/verdict/features/length_share", 0.9).size(), 1u);
  EXPECT_EQ(regressions("/mesh/verdict/quality/inverted", 1).size(), 1u);
}

TEST(BenchCompare, LostOutcomesAreRegressions) {
  EXPECT_EQ(regressions("/status", "timeout").size(), 1u);
  EXPECT_EQ(regressions("/mesh/valid", false).size(), 1u);
  const Comparison missing = compare_results(two_models(), {two_models()[0]}, {});
  ASSERT_EQ(missing.regressions.size(), 1u);
  EXPECT_EQ(missing.regressions[0].substr(0, 2), "b:");
}

TEST(BenchCompare, TimeIsJudgedInSumAndOnlyWhenAsked) {
  EXPECT_TRUE(regressions("/mesh/seconds", 20.0).empty());
  CompareTolerances strict;
  strict.time = 0.5;
  EXPECT_EQ(regressions("/mesh/seconds", 20.0, strict).size(), 1u);
  EXPECT_TRUE(regressions("/mesh/seconds", 3.0, strict).empty());
}

TEST(BenchCompare, ALostMeshIsARegression) {
  EXPECT_EQ(regressions("/mesh", Json{{"failure", "budget"}}).size(), 1u);
  std::vector<Json> after = two_models();
  after[1].erase("methods");
  EXPECT_FALSE(compare_results(two_models(), after, {}).regressions.empty());
}

}  // namespace
}  // namespace hexwright::cli
