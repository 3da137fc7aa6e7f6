// The JSON report.
#include "hexwright/pipeline/report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "hexwright/version.h"

#include "helpers.h"

namespace hexwright {
namespace {

TEST(Report, SaysWhatTheResultHolds) {
  MeshOptions options;
  options.sizing.tolerance = 0.02;
  options.sizing.max_level = 4;
  options.max_rounds = 1;
  const MeshResult r = mesh_surface(test::unit_sphere_surface(3), options, {});
  const auto json =
      nlohmann::json::parse(report_to_json(r, {"in \"quoted\".stl", "out.vtu", 2, {}}));
  EXPECT_EQ(json["version"], HEXWRIGHT_VERSION);
  EXPECT_EQ(json["input"], "in \"quoted\".stl");
  EXPECT_EQ(json["hexes"], r.mesh.num_hexes());
  EXPECT_EQ(json["valid"], r.failures.empty());
  EXPECT_EQ(json["rounds"].size(), r.rounds.size());
  EXPECT_EQ(json["rounds"].back()["valid"], r.failures.empty());
  EXPECT_EQ(json["rounds"].back()["inverted"], 0);
  EXPECT_EQ(json["rounds"].back()["topology_met"], true);
  EXPECT_EQ(json["cells_per_level"].size(), static_cast<std::size_t>(r.grid.finest_level) + 1);
  EXPECT_EQ(json["complete"]["cells"], r.complete.num_output_cells);
  EXPECT_EQ(json["verdict"]["quality"]["inverted"], 0);
  EXPECT_EQ(json["options"]["max_level"], 4);
  EXPECT_GT(json["peak_memory_bytes"], 1 << 20);
  double seconds = 0;
  for (const auto& stage : json["stages"]) seconds += stage["seconds"].get<double>();
  EXPECT_LE(seconds, json["seconds"].get<double>() * 1.001);
}

// What follows from other wishes is written as it was used.
TEST(Report, OptionsAreThoseThatTheSurfaceWasPreparedBy) {
  MeshOptions options;
  options.sizing.tolerance = 0.02;
  const auto written = [&] { return nlohmann::json::parse(mesh_options_to_json(options)); };
  EXPECT_EQ(written()["min_part"], 0.02);
  EXPECT_EQ(written()["placement"], "faces");
  EXPECT_EQ(written()["balance"], "weak");
  options.sizing.sizing = Sizing::Thickness;
  options.fit.carve.side = Side::Both;
  options.complete.pairing = Pairing::Sheets;
  EXPECT_EQ(written()["min_part"], 0);
  EXPECT_EQ(written()["placement"], "as-given");
  EXPECT_EQ(written()["side"], "both");
  EXPECT_EQ(written()["pairing"], "sheets");
  EXPECT_EQ(written()["balance"], "relaxed");
}

TEST(Report, StagesWriteTheirOwnParts) {
  CompleteReport complete;
  complete.num_output_cells = 17;
  EXPECT_EQ(nlohmann::json::parse(complete_to_json(complete))["cells"], 17);
  DualReport dual;
  dual.num_hexes = 5;
  EXPECT_EQ(nlohmann::json::parse(dual_to_json(dual))["hexes"], 5);
  FitStageResult fit;
  fit.fit.report.curves.push_back({CurveId(3), false, 0, "no path"});
  EXPECT_EQ(nlohmann::json::parse(fit_to_json(fit))["dropped_curves"][0]["reason"], "no path");
  fit.curving.emplace();
  fit.curving->held_back = {{{1, 2, 3}, 0.5, 0.1}, {{4, 5, 6}, 0, 0.05}};
  const auto curving = nlohmann::json::parse(fit_to_json(fit))["curving"];
  EXPECT_EQ(curving["held_back_edges"], 2);
  EXPECT_EQ(curving["worst_held_back"][0]["position"], nlohmann::json({1, 2, 3}));
}

}  // namespace
}  // namespace hexwright
