// Names of the surface's groups on the boundary of the mesh.
#include "fit/curves/name_labels.h"

#include <map>

#include <gtest/gtest.h>

#include "hexwright/fit/fit.h"
#include "hexwright/mesh/hex_adjacency.h"

#include "fit_helpers.h"

namespace hexwright {
namespace {

/// The cube with its top divided into "left" and "right" along a line that no crease marks; all
/// other sides are "wall".
TriMesh cube_with_divided_top() {
  TriMesh cube;
  for (int z = 0; z < 2; ++z)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x) cube.positions.push_back({0.5 * x, double(y), double(z)});
  const auto quad = [&](int a, int b, int c, int d, int group) {
    for (const auto& t : {std::array{a, b, c}, std::array{a, c, d}}) {
      cube.tris.push_back({VertId(t[0]), VertId(t[1]), VertId(t[2])});
      cube.group.push_back(group);
    }
  };
  cube.group_names = {"wall", "left", "right"};
  for (int i = 0; i < 2; ++i) {
    quad(i, i + 3, i + 4, i + 1, 0);
    quad(i + 6, i + 7, i + 10, i + 9, 1 + i);
    quad(i, i + 1, i + 7, i + 6, 0);
    quad(i + 3, i + 9, i + 10, i + 4, 0);
  }
  quad(0, 6, 9, 3, 0);
  quad(2, 5, 11, 8, 0);
  return cube;
}

HexMesh fit_to(const TriMesh& surface, const FitOptions& options = {}) {
  const Target target = wrap_target(surface);
  return fit(test::grid_around(target.tree.box(), 0.13), target, options, {}).mesh;
}

/// Area of the quads per name.
std::map<std::string, double> area_by_name(const HexMesh& mesh) {
  std::map<std::string, double> area;
  for (const LabeledQuad& quad : mesh.labels.quads) {
    std::array<Vec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.positions[quad.verts[k]];
    area[mesh.labels.patch_names[quad.patch]] += 0.5 * norm(cross(p[2] - p[0], p[3] - p[1]));
  }
  return area;
}

TEST(NameLabels, PatchesAndCurvesOfTheMeshHaveTheNamesOfTheGroups) {
  const HexMesh mesh = fit_to(cube_with_divided_top());
  ASSERT_FALSE(mesh.find_problem());
  const auto area = area_by_name(mesh);
  ASSERT_EQ(area.size(), 7u);  // wall.1 to wall.5
  EXPECT_NEAR(area.at("left"), 0.5, 1e-6);
  EXPECT_NEAR(area.at("right"), 0.5, 1e-6);
  for (int i = 1; i <= 5; ++i) EXPECT_NEAR(area.at("wall." + std::to_string(i)), 1, 1e-6);
  const auto& names = mesh.labels.curve_names;
  const auto between = std::find(names.begin(), names.end(), "left-right");
  ASSERT_NE(between, names.end());
  double length = 0;
  for (const LabeledEdge& edge : mesh.labels.edges)
    if (edge.curve == CurveId(between - names.begin()))
      length += distance(mesh.positions[edge.verts[0]], mesh.positions[edge.verts[1]]);
  EXPECT_NEAR(length, 1, 1e-9);
}

// Without curves there is one patch: it is divided along quads.
TEST(NameLabels, ABorderThatIsNotFollowedIsDrawnAlongQuads) {
  TriMesh surface = cube_with_divided_top();
  const SurfaceTree tree(surface);
  HexMesh mesh = fit_to(surface);
  for (LabeledQuad& quad : mesh.labels.quads) quad.patch = PatchId(0);
  const PatchIndex one_patch(tree, IdVector<TriId, PatchId>(surface.num_tris(), PatchId(0)));
  fitting::name_labels(tree, one_patch, {}, mesh);
  ASSERT_FALSE(mesh.find_problem());
  const auto area = area_by_name(mesh);
  ASSERT_EQ(area.size(), 3u);
  EXPECT_NEAR(area.at("left"), 0.5, 1e-6);
  EXPECT_NEAR(area.at("wall"), 5, 1e-6);
  for (const LabeledQuad& quad : mesh.labels.quads)
    EXPECT_EQ(quad.patch == PatchId(0), mesh.labels.patch_names[quad.patch] == "wall");
}

TEST(NameLabels, OneNameForAllIsThatOfTheBody) {
  TriMesh surface = cube_with_divided_top();
  surface.group.assign(surface.num_tris(), 1);
  const HexMesh mesh = fit_to(surface);
  EXPECT_TRUE(mesh.labels.patch_names.empty());
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"left"}));
  surface.group.clear();
  const HexMesh unnamed = fit_to(surface);
  EXPECT_TRUE(unnamed.region_names.empty());
  EXPECT_EQ(unnamed.positions, mesh.positions);
}

TEST(NameLabels, AroundABodyItsNameIsThatOfItsFaces) {
  TriMesh surface = cube_with_divided_top();
  surface.group.assign(surface.num_tris(), 1);
  FitOptions options;
  options.carve.side = Side::Outside;
  const HexMesh mesh = fit_to(surface, options);
  EXPECT_TRUE(mesh.region_names.empty());
  const auto area = area_by_name(mesh);
  ASSERT_EQ(area.size(), 6u);
  for (int i = 1; i <= 6; ++i) EXPECT_NEAR(area.at("left." + std::to_string(i)), 1, 1e-6) << i;
}

}  // namespace
}  // namespace hexwright
