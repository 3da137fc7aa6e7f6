// From a CAD file to a mesh: names, sharp edges, the exact boundary.
#include "hexwright/pipeline/mesh_cad.h"

#include <cmath>
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "hexwright/pipeline/report.h"

namespace hexwright {
namespace {

#define NEEDS_CAD() \
  if (!can_read_cad()) GTEST_SKIP() << "needs OpenCASCADE: run scripts/setup, then scripts/build"

CadInput load(const std::string& name, const MeshOptions& options,
              const std::vector<std::string>& rules = {}) {
  const auto path = std::filesystem::path(HEXWRIGHT_SOURCE_DIR) / "data/cad" / name;
  std::vector<PatchRule> parsed;
  for (const std::string& rule : rules) parsed.push_back(parse_patch_rule(rule));
  return prepare_cad(read_cad(path, read_options_for(options)), std::move(parsed), options);
}

std::set<std::string> names_of_patches(const HexMesh& mesh) {
  return {mesh.labels.patch_names.begin(), mesh.labels.patch_names.end()};
}

TEST(MeshCad, NamesPatchesAndRegionAndFollowsEdges) {
  NEEDS_CAD();
  const MeshOptions options;
  const CadInput input = load("plate_hole.step", options);
  const MeshResult result = mesh_cad(input, options, {});
  EXPECT_TRUE(result.failures.empty());
  EXPECT_EQ(result.mesh.region_names, std::vector<std::string>{"plate"});
  EXPECT_EQ(names_of_patches(result.mesh),
            (std::set<std::string>{"fixed", "pulled", "bore", "color_ff0000", "face_2", "face_4",
                                   "face_5"}));
  ASSERT_TRUE(result.verdict.features);
  EXPECT_GE(result.verdict.features->length_share, 0.98);
}

/// Vertices of the bore are on its cylinder to rounding, not on its triangles.
TEST(MeshCad, PutsTheBoundaryOntoTheExactShape) {
  NEEDS_CAD();
  const MeshOptions options;
  const MeshResult result = mesh_cad(load("plate_hole.step", options), options, {});
  ASSERT_TRUE(result.exact);
  EXPECT_GE(result.exact->num_exact, result.exact->num_verts * 97 / 100);
  std::size_t num_bore = 0, num_on = 0;
  for (const LabeledQuad& quad : result.mesh.labels.quads) {
    if (result.mesh.labels.patch_names[quad.patch] != "bore") continue;
    for (const VertId v : quad.verts) {
      const Vec3& p = result.mesh.positions[v];
      const double radius = std::sqrt((p.x - 20) * (p.x - 20) + (p.y - 10) * (p.y - 10));
      ++num_bore;
      num_on += std::abs(radius - 5) < 1e-8;
    }
  }
  EXPECT_GT(num_bore, 0u);
  EXPECT_GE(num_on, num_bore * 95 / 100);
}

TEST(MeshCad, GivesEachSeparateBodyItsRegion) {
  NEEDS_CAD();
  const MeshOptions options;
  const MeshResult result = mesh_cad(load("two_solids.step", options), options, {});
  EXPECT_EQ(std::set<std::string>(result.mesh.region_names.begin(), result.mesh.region_names.end()),
            (std::set<std::string>{"base+pin", "rail"}));
  for (const HexId h : result.mesh.hexes.ids()) {
    const bool is_rail =
        result.mesh.region_names[static_cast<std::size_t>(result.mesh.region[h])] == "rail";
    EXPECT_EQ(is_rail, result.mesh.corners(h)[0].x > 25);
  }
}

/// Each is meshed by itself, with the features that are its own.
TEST(MeshCad, SolidsKeptApartAreRegionsOfTheirOwn) {
  NEEDS_CAD();
  MeshOptions options;
  options.target.prepare.parts = Parts::Separate;
  const MeshResult result = mesh_cad(load("two_solids.step", options), options, {});
  EXPECT_EQ(std::set<std::string>(result.mesh.region_names.begin(), result.mesh.region_names.end()),
            (std::set<std::string>{"base", "pin", "rail"}));
  for (const std::string& warning : result.warnings)
    EXPECT_EQ(warning.find("feature edges"), std::string::npos) << warning;
}

TEST(MeshCad, RulesPickFaces) {
  NEEDS_CAD();
  MeshOptions options;
  options.max_rounds = 0;
  const CadInput input = load("plate_hole.step", options,
                              {"hole=cylinder:r=5", "left=plane:z=5&plane:x<20", "no=sphere:r=1"});
  EXPECT_GT(input.num_matched[0], 0u);
  EXPECT_EQ(input.num_matched[2], 0u);
  const std::set<std::string> names = names_of_patches(mesh_cad(input, options, {}).mesh);
  EXPECT_TRUE(names.contains("hole"));
  EXPECT_TRUE(names.contains("left"));
  EXPECT_FALSE(names.contains("bore"));
}

TEST(MeshCad, ReportsTheModelAndTheExactBoundary) {
  NEEDS_CAD();
  MeshOptions options;
  options.max_rounds = 0;
  const CadInput input = load("plate_hole.step", options);
  const MeshResult result = mesh_cad(input, options, {});
  RunInfo run{"plate_hole.step", "out.vtu", 1};
  run.cad = summarize_cad(input.model, input.surface);
  const std::string report = report_to_json(result, run);
  for (const char* key : {"\"exact_boundary\"", "\"cylinder r=5 along z through (20, 10, 0)\"",
                          "\"named_faces\": 4", "\"file_unit\": \"millimetre\""})
    EXPECT_NE(report.find(key), std::string::npos) << key;
}

TEST(MeshCad, NamesCurvesByNamedEdges) {
  NEEDS_CAD();
  MeshOptions options;
  options.max_rounds = 0;
  CadInput input = load("plate_hole.step", options);
  for (CadEdge& edge : input.model.edges) {
    const Vec3 p = input.model.surface.positions[edge.verts[0]];
    if (edge.kind == CadEdgeClass::Sharp && edge.verts.front() == edge.verts.back() && p.z > 4)
      edge.name = "rim";
  }
  const HexMesh mesh = mesh_cad(input, options, {}).mesh;
  const auto& names = mesh.labels.curve_names;
  const auto rim = std::ranges::find(names, "rim");
  ASSERT_NE(rim, names.end());
  const CurveId curve(rim - names.begin());
  for (const LabeledEdge& edge : mesh.labels.edges) {
    if (edge.curve != curve) continue;
    for (const VertId v : edge.verts) EXPECT_NEAR(mesh.positions[v].z, 5, 0.05);
  }
}

}  // namespace
}  // namespace hexwright
