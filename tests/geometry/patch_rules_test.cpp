// Rules that name parts of a surface, imprinted into its triangles.
#include "hexwright/geometry/patch_rules.h"

#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/geometry/prepare_surface.h"
#include "hexwright/geometry/surface_topology.h"

#include "helpers.h"

namespace hexwright {
namespace {

RuledSurface apply(const TriMesh& surface, const std::vector<std::string>& texts) {
  std::vector<PatchRule> rules;
  for (const std::string& text : texts) rules.push_back(parse_patch_rule(text));
  return apply_patch_rules(surface, rules);
}

std::map<std::string, double> area_by_name(const TriMesh& mesh) {
  EXPECT_FALSE(mesh.find_problem());
  std::map<std::string, double> area;
  for (TriId t : mesh.tris.ids()) {
    const auto c = mesh.corners(t);
    area[mesh.group_names[static_cast<std::size_t>(mesh.group[t])]] +=
        0.5 * norm(cross(c[1] - c[0], c[2] - c[0]));
  }
  return area;
}

/// The cube as STL files have it: three vertices of its own for every triangle.
TriMesh cube_soup() {
  const TriMesh cube = test::unit_cube_surface();
  TriMesh soup;
  for (TriId t : cube.tris.ids()) {
    std::array<VertId, 3> tri;
    for (std::size_t k = 0; k < 3; ++k)
      tri[k] = soup.positions.push_back(cube.positions[cube.tris[t][k]]);
    soup.tris.push_back(tri);
  }
  return soup;
}

TEST(PatchRules, ASideAtAPlaneIsNamedWithoutACut) {
  for (const char* rule : {"low=plane:x<0", "low=plane:x=0", "low=plane:x<1e-6",
                           "low=normal:-1,0,0", "low=box:-1,-1,-1,0,2,2"}) {
    const RuledSurface ruled = apply(test::unit_cube_surface(), {rule});
    EXPECT_EQ(ruled.surface.num_tris(), 12u) << rule;
    EXPECT_EQ(ruled.num_matched[0], 2u) << rule;
    EXPECT_NEAR(area_by_name(ruled.surface)["low"], 1, 1e-12) << rule;
  }
}

TEST(PatchRules, APlaneAcrossTheSurfaceIsImprinted) {
  for (const TriMesh& cube : {test::unit_cube_surface(), cube_soup()}) {
    const RuledSurface ruled = apply(cube, {"front=plane:y<0.3", "back=plane:y>=0.3"});
    auto area = area_by_name(ruled.surface);
    EXPECT_NEAR(area["front"], 1 + 4 * 0.3, 1e-12);
    EXPECT_NEAR(area["back"], 1 + 4 * 0.7, 1e-12);
    EXPECT_TRUE(compute_topology(prepare_surface(ruled.surface, {}).mesh).is_closed_manifold());
  }
}

TEST(PatchRules, ABoxIsASpotOnAFaceOfTwoTriangles) {
  const RuledSurface ruled = apply(cube_soup(), {"spot=box:0.2,0.3,0.9,0.4,0.6,2"});
  EXPECT_NEAR(area_by_name(ruled.surface)["spot"], 0.2 * 0.3, 1e-12);
  EXPECT_TRUE(compute_topology(prepare_surface(ruled.surface, {}).mesh).is_closed_manifold());
}

TEST(PatchRules, ASphereOrCylinderIsARoundSpot) {
  constexpr double kRadius = 0.2;
  const double expected = std::numbers::pi * kRadius * kRadius;
  for (const char* rule :
       {"spot=sphere:0.5,0.45,1,0.2", "spot=cylinder:0.5,0.45,0,0,0,2,0.2&plane:z>1"}) {
    const RuledSurface ruled = apply(cube_soup(), {rule});
    EXPECT_NEAR(area_by_name(ruled.surface)["spot"] / expected, 1, 0.01) << rule;
    EXPECT_TRUE(compute_topology(prepare_surface(ruled.surface, {}).mesh).is_closed_manifold());
  }
}

TEST(PatchRules, TheFirstMatchCountsAndOthersKeepTheirNames) {
  TriMesh cube = test::unit_cube_surface();
  cube.group_names = {"shell", "x"};
  cube.group.assign(12, 0);
  cube.group[TriId(0)] = 1;
  const RuledSurface ruled = apply(
      cube, {"top=plane:z=1", "shell=normal:0,1,0;10deg", "never=plane:z>2", "all=plane:z>0.5"});
  EXPECT_EQ(ruled.num_matched[2], 0u);
  auto area = area_by_name(ruled.surface);
  EXPECT_NEAR(area["top"], 1, 1e-12);
  EXPECT_NEAR(area["all"], 1.5, 1e-12);
  EXPECT_NEAR(area["shell"] + area["x"], 3.5, 1e-12);
}

TEST(PatchRules, AFileNamesWhatLiesOnIt) {
  PatchRule rule = parse_patch_rule("label=file:part.stl");
  EXPECT_EQ(rule.conditions[0].path, "part.stl");
  TriMesh piece = test::unit_cube_surface();
  piece.tris.resize(2);
  rule.conditions[0].surface = piece;
  EXPECT_EQ(apply_patch_rules(test::unit_cube_surface(), std::array{rule}).num_matched[0], 2u);
}

// A prism of twelve sides about the z axis, closed by fans: neighbouring sides turn by 30 degrees.
TriMesh twelve_sides() {
  TriMesh prism;
  constexpr int kSides = 12;
  for (int k = 0; k < kSides; ++k)
    for (double z : {0.0, 1.0}) {
      const double t = 2 * std::numbers::pi * k / kSides;
      prism.positions.push_back({std::cos(t), std::sin(t), z});
    }
  const VertId low = prism.positions.push_back({0, 0, 0}),
               high = prism.positions.push_back({0, 0, 1});
  for (int k = 0; k < kSides; ++k) {
    const VertId a(2 * k), b(2 * ((k + 1) % kSides)), c(2 * k + 1), d(2 * ((k + 1) % kSides) + 1);
    prism.tris.push_back({a, b, d});
    prism.tris.push_back({a, d, c});
    prism.tris.push_back({low, b, a});
    prism.tris.push_back({high, c, d});
  }
  return prism;
}

TEST(PatchRules, AnAngleNamesWhatLiesBetweenSharpEdges) {
  for (const TriMesh& cube : {test::unit_cube_surface(), cube_soup()})
    for (const auto& [rule, matched] :
         std::map<std::string, std::size_t>{{"side=angle:0,0.5,0.4", 2},
                                            {"side=angle:9,0.5,0.4;89deg", 2},
                                            {"side=angle:0,0.5,0.4;91", 12}})
      EXPECT_EQ(apply(cube, {rule}).num_matched[0], matched) << rule;
  const TriMesh prism = twelve_sides();
  EXPECT_EQ(apply(prism, {"mantle=angle:1,0,0.5;31deg"}).num_matched[0], 24u);
  EXPECT_EQ(apply(prism, {"mantle=angle:1,0.1,0.5;29deg"}).num_matched[0], 2u);
  EXPECT_EQ(apply(prism, {"top=angle:0.1,0.2,1"}).num_matched[0], 12u);
  TriMesh turned = prism;  // every second triangle looks the other way
  for (TriId t : turned.tris.ids())
    if (t.value() % 2 == 0) std::swap(turned.tris[t][0], turned.tris[t][1]);
  EXPECT_EQ(apply(turned, {"mantle=angle:1,0,0.5;31deg"}).num_matched[0], 24u);
  const RuledSurface both = apply(prism, {"half=angle:1,0,0.5;31deg&plane:z<0.5"});
  EXPECT_NEAR(area_by_name(both.surface)["half"], 6 * 2 * std::sin(std::numbers::pi / 12), 1e-12);
}

// Two walls that meet in a right angle, with a triangle without area between them.
TEST(PatchRules, AnAngleIsNotHiddenByATriangleWithoutArea) {
  TriMesh walls;
  walls.positions = {{0, 0, 0}, {0, 2, 0}, {1, 1, 0}, {0, 1, 1}, {0, 1, 0}};
  walls.tris = {{VertId(0), VertId(2), VertId(1)},
                {VertId(0), VertId(1), VertId(4)},
                {VertId(4), VertId(3), VertId(0)},
                {VertId(1), VertId(3), VertId(4)}};
  EXPECT_EQ(apply(walls, {"floor=angle:0.5,1,0;30deg"}).num_matched[0], 2u);
  EXPECT_EQ(apply(walls, {"floor=angle:0.5,1,0;91deg"}).num_matched[0], 4u);
  EXPECT_EQ(apply(walls, {"wall=angle:0,1.1,0.5;30deg"}).num_matched[0], 3u);
}

TEST(PatchRules, OthersAreRefusedWithAnExample) {
  for (const char* text : {"",
                           "inlet",
                           "=plane:x<1",
                           "a=",
                           "a=plane",
                           "a=plane:",
                           "a=plane:x",
                           "a=plane:w<1",
                           "a=plane:x<",
                           "a=plane:x<y",
                           "a=plane:x~1",
                           "a=plane:x<1e999",
                           "a=box:1,2,3",
                           "a=sphere:0,0,0,0",
                           "a=sphere:0,0,0,-1",
                           "a=cylinder:0,0,0,0,0,0,1",
                           "a=normal:0,0,0",
                           "a=normal:0,0,1;x",
                           "a=normal:0,0,1;-5",
                           "a=torus:1",
                           "a=file:",
                           "a=plane:x<1&",
                           "a=plane:x<1 2"}) {
    try {
      parse_patch_rule(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::BadArgument) << text;
      EXPECT_NE(std::string(error.what()).find("inlet=plane:x<0.001"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace hexwright
