// Sizes that users ask for, in the finished mesh.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/mesh/hex_adjacency.h"
#include "hexwright/pipeline/mesh_surface.h"
#include "hexwright/pipeline/size_plan.h"

#include "helpers.h"
#include "io/temp_folder.h"
#include "solids.h"

namespace hexwright {
namespace {

TriMesh cube_of_ten() { return test::box_surface({0, 0, 0}, {10, 10, 10}); }

MeshOptions with_size(double size) {
  MeshOptions options;
  options.sizes.size = {size, false};
  return options;
}

/// Of the edges of hexes whose centres lie in a box, 90% are no longer.
double high_edge_in(const HexMesh& mesh, const Box3& box) {
  std::vector<double> lengths;
  for (HexId h : mesh.hexes.ids()) {
    const auto p = mesh.corners(h);
    Vec3 center;
    for (const Vec3& q : p) center += q * 0.125;
    if (!box.contains(center)) continue;
    for (const auto& e : kHexEdges)
      lengths.push_back(
          distance(p[static_cast<std::size_t>(e[0])], p[static_cast<std::size_t>(e[1])]));
  }
  std::sort(lengths.begin(), lengths.end());
  return lengths.empty() ? 0 : lengths[lengths.size() * 9 / 10];
}

std::set<std::string> names_of(const HexMesh& mesh) {
  std::set<std::string> names;
  for (const std::string& name : mesh.labels.patch_names)
    if (!name.empty()) names.insert(name);
  return names;
}

void expect_done(const MeshResult& r) {
  for (const std::string& f : r.failures) ADD_FAILURE() << f;
  EXPECT_TRUE(r.verdict.is_valid());
}

TEST(Sizes, ACubeOfTenHasAThousandHexesOfOne) {
  const MeshResult r = mesh_surface(cube_of_ten(), with_size(1), {});
  expect_done(r);
  EXPECT_EQ(r.mesh.num_hexes(), 1000u);
  EXPECT_LE(r.edges.max, 1.05);
  EXPECT_GE(r.edges.min, 0.95);
}

TEST(Sizes, SharesAreOfTheDiagonal) {
  MeshOptions options = with_size(0.1 / std::sqrt(3));
  options.sizes.size.is_share = true;
  EXPECT_EQ(mesh_surface(cube_of_ten(), options, {}).mesh.num_hexes(), 1000u);
}

TEST(Sizes, NearlyAllEdgesOfCurvedPartsKeepToTheSize) {
  for (double size : {0.35, 0.2}) {
    const MeshResult r = mesh_surface(test::unit_sphere_surface(4), with_size(size), {});
    expect_done(r);
    EXPECT_LE(r.edges.high, 1.05 * size) << size;
    EXPECT_GE(r.edges.median, 0.5 * size) << size;
  }
}

TEST(Sizes, RegionsAreFinerAndTheRestIsNot) {
  MeshOptions options = with_size(1);
  options.sizes.rules = {parse_size_rule("box:0,0,0,3,3,3=0.5"),
                         parse_size_rule("ball:10,10,10,1=0.5")};
  const MeshResult r = mesh_surface(cube_of_ten(), options, {});
  expect_done(r);
  EXPECT_LE(high_edge_in(r.mesh, {{0, 0, 0}, {2.5, 2.5, 2.5}}), 0.55);
  EXPECT_LE(high_edge_in(r.mesh, {{9, 9, 9}, {10, 10, 10}}), 0.55);
  EXPECT_GE(high_edge_in(r.mesh, {{0, 7, 0}, {3, 10, 3}}), 0.8);
}

TEST(Sizes, PatchesAreRefinedByName) {
  TriMesh cube = cube_of_ten();
  cube.group_names = {"rest", "top"};
  for (TriId t : cube.tris.ids()) {
    const auto p = cube.corners(t);
    cube.group.push_back(p[0].z + p[1].z + p[2].z == 30 ? 1 : 0);
  }
  MeshOptions options = with_size(2);
  options.sizes.rules = {parse_size_rule("patch:to?=1")};
  const MeshResult r = mesh_surface(cube, options, {});
  expect_done(r);
  EXPECT_LE(high_edge_in(r.mesh, {{0, 0, 9}, {10, 10, 10}}), 1.1);
  EXPECT_GE(high_edge_in(r.mesh, {{0, 0, 0}, {10, 10, 3}}), 1.8);
  options.sizes.rules = {parse_size_rule("patch:bottom=1")};
  try {
    mesh_surface(cube, options, {});
    ADD_FAILURE() << "a patch that does not exist";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("rest, top"), std::string::npos) << error.what();
  }
}

TEST(Sizes, ThreeCellsStandAcrossAWall) {
  MeshOptions options;
  options.sizes.across = 3;
  const MeshResult r = mesh_surface(test::box_surface({0, 0, 0}, {10, 10, 1}), options, {});
  expect_done(r);
  // Along z every edge is at most a third of the wall.
  for (HexId h : r.mesh.hexes.ids()) {
    const auto p = r.mesh.corners(h);
    double lo = p[0].z, hi = p[0].z;
    for (const Vec3& q : p) lo = std::min(lo, q.z), hi = std::max(hi, q.z);
    EXPECT_LE(hi - lo, 0.45);
  }
}

TEST(Sizes, ANumberOfHexesIsMetWithinFivePercent) {
  MeshOptions options;
  options.sizes.cells = 3000;
  const MeshResult r = mesh_surface(test::unit_sphere_surface(4), options, {});
  expect_done(r);
  EXPECT_NEAR(static_cast<double>(r.mesh.num_hexes()), 3000, 150);
}

TEST(Sizes, ABoxOfAnyProportionsIsFilledAndItsSidesAreNamed) {
  const Box3 box{{-7, -3, -4}, {23, 13.5, 16}};
  MeshOptions options = with_size(1);
  options.fit.carve.side = Side::Outside;
  options.sizes.box = box;
  const MeshResult r = mesh_surface(cube_of_ten(), options, {});
  expect_done(r);
  const Box3 filled = bounding_box(r.mesh);
  EXPECT_NEAR(distance(filled.lo, box.lo), 0, 1e-9);
  EXPECT_NEAR(distance(filled.hi, box.hi), 0, 1e-9);
  const Vec3 extent = box.extent();
  EXPECT_NEAR(r.verdict.quality.total_volume, extent.x * extent.y * extent.z - 1000, 1);
  EXPECT_EQ(names_of(r.mesh),
            (std::set<std::string>{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"}));
  std::size_t num_boundary = compute_hex_neighbors(r.mesh).boundary.size();
  EXPECT_EQ(r.mesh.labels.quads.size(), num_boundary);
}

TEST(Sizes, MarginsAreLengthsOrMultiples) {
  MeshOptions options = with_size(2);
  options.fit.carve.side = Side::Both;
  options.sizes.margin = parse_margin("5,0.5L,3,4,1L,2");
  const Box3 filled = bounding_box(mesh_surface(cube_of_ten(), options, {}).mesh);
  EXPECT_NEAR(distance(filled.lo, {-5, -3, -10}), 0, 1e-9);
  EXPECT_NEAR(distance(filled.hi, {15, 14, 12}), 0, 1e-9);
}

TEST(SizeWishes, ContradictionsNameBothOptions) {
  const auto message_of = [](SizeWishes wishes, Side side = Side::Inside) {
    try {
      check_size_wishes(wishes, side, 10);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const auto names = [](const std::string& message, const char* a, const char* b) {
    return message.find(a) != std::string::npos && message.find(b) != std::string::npos;
  };
  SizeWishes w;
  w.size = {2, false};
  EXPECT_EQ(message_of(w), "accepted");
  w.max_size = {0.1, true};  // 1
  EXPECT_PRED3(names, message_of(w), "--size", "--max-size");
  w = {};
  w.size = {2, false};
  w.min_size = {3, false};
  EXPECT_PRED3(names, message_of(w), "--size", "--min-size");
  w = {};
  w.min_size = {3, false};
  w.rules = {parse_size_rule("ball:0,0,0,1=2")};
  EXPECT_PRED3(names, message_of(w), "--min-size", "--refine");
  w = {};
  w.size = {2, false};
  w.cells = 100;
  EXPECT_PRED3(names, message_of(w), "--cells", "--size");
  w = {};
  w.box = parse_box("0,0,0,1,1,1");
  EXPECT_PRED3(names, message_of(w), "--box", "--side");
  EXPECT_EQ(message_of(w, Side::Outside), "accepted");
  w.margin = parse_margin("1");
  EXPECT_PRED3(names, message_of(w, Side::Both), "--box", "--margin");
}

TEST(SizeWishes, WrongRulesAreRefusedWithARightForm) {
  for (const char* text :
       {"", "box", "box:1,2,3=1", "box:0,0,0,1,1,1", "box:1,0,0,0,1,1=1", "ball:0,0,0,-1=1",
        "ball:0,0,0,1=0", "ball:0,0,0,1=1,2,3", "ring:0=1", "patch:=1", "patch:(=1"})
    EXPECT_THROW(parse_size_rule(text), Error) << text;
  const SizeRule rule = parse_size_rule("cylinder:0,0,0,0,0,5,2=1%,3");
  EXPECT_TRUE(rule.size.is_share);
  EXPECT_DOUBLE_EQ(rule.size.in(200), 2);
  EXPECT_DOUBLE_EQ(rule.distance.value, 3);
  EXPECT_DOUBLE_EQ(rule.radius, 2);
  EXPECT_THROW(parse_margin("1,2"), Error);
  EXPECT_THROW(parse_margin("-1"), Error);
  EXPECT_THROW(parse_box("0,0,0,1,1,0"), Error);
  EXPECT_THROW(parse_length("0"), Error);
}

TEST(SizeWishes, AFileHoldsMany) {
  const test::TempFolder folder;
  const std::string path = folder / "sizes.json";
  folder.write("sizes.json", R"({"size": 2, "max-size": "40%", "growth": 1.3, "across": 2,
    "refine": ["box:0,0,0,1,1,1=0.5", "patch:wall.*=0.2,1"], "margin": "5L"})");
  SizeWishes wishes;
  read_size_wishes(path, wishes);
  EXPECT_DOUBLE_EQ(wishes.size.value, 2);
  EXPECT_TRUE(wishes.max_size.is_share);
  EXPECT_DOUBLE_EQ(wishes.growth, 1.3);
  EXPECT_EQ(wishes.across, 2);
  ASSERT_EQ(wishes.rules.size(), 2u);
  EXPECT_EQ(wishes.rules[1].pattern, "wall.*");
  EXPECT_TRUE(wishes.margin && (*wishes.margin)[3].is_multiple);
  for (const char* text : {"", "[]", R"({"sise": 1})", R"({"size": -1})", R"({"refine": "x"})"}) {
    folder.write("sizes.json", text);
    try {
      read_size_wishes(path, wishes);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace hexwright
