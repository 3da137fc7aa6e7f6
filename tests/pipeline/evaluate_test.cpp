// The evaluation of one surface.
#include "hexwright/pipeline/evaluate.h"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/io/surface_io.h"

#include "helpers.h"

namespace hexwright {
namespace {

EvaluateOptions small() {
  EvaluateOptions options = default_evaluate_options();
  options.sizing.max_level = 4;
  options.mesh.sizing.tolerance = 0.03;
  options.mesh.sizing.max_level = 4;
  options.mesh.max_rounds = 0;
  return options;
}

TriMesh holes() { return read_surface(test::bundled("models/3holes.obj")).mesh; }

TEST(Evaluate, EveryMethodCompletesTheSameInputGrid) {
  const ModelRecord r = evaluate_model(holes(), small(), {});
  EXPECT_GT(r.input.num_cells(), 8u);
  for (int m = 0; m < kNumMethods; ++m) {
    const MethodRecord& method = r.methods[m];
    SCOPED_TRACE(evaluated_methods()[m].key);
    EXPECT_EQ(method.failure, "");
    EXPECT_EQ(method.report.num_input_cells, r.input.num_cells());
    EXPECT_EQ(method.report.num_output_cells, method.grid.num_cells());
    EXPECT_EQ(method.growth(), method.grid.num_cells() - r.input.num_cells());
    EXPECT_FALSE(find_unbalanced(method.grid, evaluated_methods()[m].complete.balance));
    ASSERT_TRUE(method.dual);
    EXPECT_GT(method.dual->num_hexes, 0u);
  }
  for (int m = 0; m < 3; ++m) EXPECT_FALSE(find_unpaired(r.methods[m].grid));
}

TEST(Evaluate, RigidOctreesGrowMostAndSheetsLeast) {
  EvaluateOptions options = small();
  options.run_mesh = false;
  const ModelRecord r = evaluate_model(holes(), options, {});
  EXPECT_LE(r.methods[1].grid.num_cells(), r.methods[0].grid.num_cells());
  EXPECT_LT(r.methods[2].grid.num_cells(), r.methods[1].grid.num_cells());
  EXPECT_LE(r.methods[3].grid.num_cells(), r.methods[2].grid.num_cells());
  EXPECT_FALSE(r.mesh);
}

TEST(Evaluate, TheRootIsTheSmallestCubeAroundTheSurface) {
  TriMesh cube = test::unit_cube_surface();
  for (Vec3& p : cube.positions) p = {7 + 3 * p.x, 5 + 2 * p.y, 1 + p.z};
  EvaluateOptions options = small();
  options.run_mesh = options.run_dual = false;
  const ModelRecord r = evaluate_model(cube, options, {});
  EXPECT_NEAR(r.input.frame.root_size, 3, 1e-6);
  EXPECT_NEAR(r.input.frame.origin.x, 7, 1e-6);
  EXPECT_NEAR(r.input.frame.origin.y, 4.5, 1e-6);
}

TEST(Evaluate, PartsAreReportedAsTheyAreDone) {
  std::vector<std::string> parts;
  evaluate_model(test::unit_cube_surface(), small(), {}, [&](const ModelRecord& r) {
    int done = 0;
    for (const MethodRecord& m : r.methods) done += m.has_grid() ? 1 : 0;
    parts.push_back(std::to_string(done) + (r.mesh ? " mesh" : ""));
  });
  EXPECT_EQ(parts, (std::vector<std::string>{"0", "1", "2", "3", "4", "4 mesh"}));
}

TEST(Evaluate, AMeshThatFailsLeavesItsMessageAndTheGrids) {
  EvaluateOptions options = small();
  options.mesh.max_hexes = 10;
  const ModelRecord r = evaluate_model(holes(), options, {});
  EXPECT_FALSE(r.mesh);
  EXPECT_NE(r.mesh_failure.find("budget"), std::string::npos) << r.mesh_failure;
  EXPECT_TRUE(r.methods[3].has_grid());
  const auto json = nlohmann::json::parse(record_to_json(r));
  EXPECT_EQ(json["mesh"]["failure"], r.mesh_failure);
}

TEST(Evaluate, CountsAreTheSameForAnyNumberOfThreads) {
  const auto counts = [](int threads) {
    const ThreadLimit limit(threads);
    const ModelRecord r = evaluate_model(holes(), small(), {});
    std::vector<std::size_t> n = {r.input.num_cells(), r.mesh->mesh.num_hexes()};
    for (const MethodRecord& m : r.methods) {
      n.push_back(m.grid.num_cells());
      n.push_back(m.dual->num_hexes);
    }
    return n;
  };
  EXPECT_EQ(counts(1), counts(2));
}

TEST(Evaluate, TheRecordSaysWhatWasCounted) {
  const ModelRecord r = evaluate_model(holes(), small(), {});
  const auto json = nlohmann::json::parse(record_to_json(r));
  EXPECT_EQ(json["surface"]["triangles"], r.num_tris);
  EXPECT_EQ(json["input"]["cells"], r.input.num_cells());
  for (int m = 0; m < kNumMethods; ++m) {
    const auto& method = json["methods"][evaluated_methods()[m].key];
    EXPECT_EQ(method["cells"], r.methods[m].grid.num_cells());
    EXPECT_EQ(method["hexes"], r.methods[m].dual->num_hexes);
    std::size_t sum = 0;
    for (const auto& n : method["cells_per_level"]) sum += n.get<std::size_t>();
    EXPECT_EQ(sum, r.methods[m].grid.num_cells());
  }
  EXPECT_EQ(json["mesh"]["hexes"], r.mesh->mesh.num_hexes());
  EXPECT_EQ(json["mesh"]["verdict"]["quality"]["inverted"], 0);
}

TEST(Evaluate, OptionsThatChangeResultsChangeTheirText) {
  const EvaluateOptions options = small();
  EvaluateOptions other = options;
  other.sizing.max_level = 5;
  EXPECT_NE(evaluate_options_to_json(options), evaluate_options_to_json(other));
  other = options;
  other.mesh.max_rounds = 3;
  EXPECT_NE(evaluate_options_to_json(options), evaluate_options_to_json(other));
  EXPECT_EQ(evaluate_options_to_json(options), evaluate_options_to_json(small()));
}

TEST(Evaluate, ASurfaceThatEnclosesNothingIsRefused) {
  TriMesh flat;
  flat.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  flat.tris.push_back({VertId(0), VertId(1), VertId(2)});
  EXPECT_THROW(evaluate_model(flat, small(), {}), Error);
}

TEST(Evaluate, LeavesBecomeHexesOfTheSameVolume) {
  const ModelRecord r = evaluate_model(test::unit_cube_surface(), small(), {});
  const HexMesh mesh = leaves_as_hexes(r.input);
  EXPECT_EQ(mesh.num_hexes(), r.input.num_cells());
  EXPECT_FALSE(mesh.find_problem());
  EXPECT_NEAR(summarize_quality(mesh).total_volume, std::pow(r.input.frame.root_size, 3), 1e-9);
}

}  // namespace
}  // namespace hexwright
