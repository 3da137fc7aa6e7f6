// Regions, fields and units in sizes, and what binds them.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <span>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "hexwright/base/error.h"
#include "hexwright/mesh/hex_adjacency.h"
#include "hexwright/pipeline/mesh_surface.h"
#include "hexwright/pipeline/option_table.h"
#include "hexwright/pipeline/report.h"
#include "hexwright/pipeline/size_plan.h"

#include "helpers.h"
#include "io/temp_folder.h"
#include "pipeline/shared_budget.h"
#include "solids.h"

namespace hexwright {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

TriMesh cube_of_ten() { return test::box_surface({0, 0, 0}, {10, 10, 10}); }

/// Two boxes with a group each.
TriMesh two_bodies() {
  TriMesh both = test::box_surface({0, 0, 0}, {4, 4, 4});
  const TriMesh right = test::box_surface({10, 0, 0}, {14, 4, 4});
  both.group_names = {"left", "right"};
  both.group.assign(both.num_tris(), 0);
  const std::size_t first = both.num_verts();
  for (const Vec3& p : right.positions) both.positions.push_back(p);
  for (auto tri : right.tris) {
    for (VertId& v : tri) v = VertId(v.index() + first);
    both.tris.push_back(tri);
    both.group.push_back(1);
  }
  return both;
}

/// The mean volume of hexes whose centres lie in a box.
double mean_volume_in(const HexMesh& mesh, const Box3& box) {
  double volume = 0;
  int count = 0;
  for (HexId h : mesh.hexes.ids()) {
    const auto p = mesh.corners(h);
    Vec3 center;
    for (const Vec3& q : p) center += q * 0.125;
    if (!box.contains(center)) continue;
    volume += std::abs(det(p[1] - p[0], p[3] - p[0], p[4] - p[0]));
    ++count;
  }
  return count > 0 ? volume / count : 0;
}

MeshResult mesh_with(const TriMesh& surface, const std::vector<std::string>& rules,
                     double max_size = 2, Side side = Side::Inside) {
  MeshOptions options;
  options.target.placement = Placement::AsGiven;
  options.sizes.max_size = {max_size, false};
  options.fit.carve.side = side;
  for (const std::string& rule : rules) options.sizes.rules.push_back(parse_size_rule(rule));
  return mesh_surface(surface, options, {});
}

std::string message_of(const TriMesh& surface, const MeshOptions& options) {
  try {
    mesh_surface(surface, options, {});
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SizePlaces, ARegionIsABodyByItsName) {
  const MeshResult r = mesh_with(two_bodies(), {"region:ri.*=0.5"}, 1);
  EXPECT_TRUE(r.failures.empty());
  const double left = mean_volume_in(r.mesh, {{0, 0, 0}, {4, 4, 4}});
  const double right = mean_volume_in(r.mesh, {{10, 0, 0}, {14, 4, 4}});
  EXPECT_GE(left, 0.8);
  EXPECT_LE(left, 1.01);
  EXPECT_LE(right, 0.126);
  EXPECT_GE(right, 0.125 / 2);
}

TEST(SizePlaces, InsideAndOutsideAreRegionsOfEveryObject) {
  const TriMesh box = test::box_surface({0, 0, 0}, {4, 4, 4});
  MeshOptions options;
  options.fit.carve.side = Side::Both;
  options.sizes.max_size = {2, false};
  options.sizes.margin = parse_margin("8");
  options.sizes.rules = {parse_size_rule("region:inside=0.5")};
  const MeshResult r = mesh_surface(box, options, {});
  EXPECT_LE(mean_volume_in(r.mesh, {{1, 1, 1}, {3, 3, 3}}), 0.126);
  EXPECT_GT(mean_volume_in(r.mesh, {{-8, -8, -8}, {-6, -6, -6}}), 4);
  options.sizes.rules = {parse_size_rule("region:outside=1")};
  const MeshResult out = mesh_surface(box, options, {});
  EXPECT_LE(mean_volume_in(out.mesh, {{-8, -8, -8}, {-6, -6, -6}}), 1.01);
}

TEST(SizePlaces, RegionsThatAreNoneAreRefusedWithThoseThereAre) {
  MeshOptions options;
  options.sizes.rules = {parse_size_rule("region:middle=1")};
  EXPECT_NE(message_of(two_bodies(), options).find("left, right"), std::string::npos);
  TriMesh cube = cube_of_ten();
  cube.group_names = {"rest", "top"};
  for (TriId t : cube.tris.ids()) {
    const auto p = cube.corners(t);
    cube.group.push_back(p[0].z + p[1].z + p[2].z == 30 ? 1 : 0);
  }
  options.sizes.rules = {parse_size_rule("region:top=1")};
  EXPECT_NE(message_of(cube, options).find("enclose no region"), std::string::npos);
}

TEST(SizePlaces, TheInsideOfAFileIsARegion) {
  const test::TempFolder folder;
  const auto path = folder / "region.off";
  // A tetrahedron with its right angle at the cube's corner.
  std::ofstream(path) << "OFF\n4 4 0\n-1 -1 -1\n9 -1 -1\n-1 9 -1\n-1 -1 9\n"
                      << "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  const MeshResult r = mesh_with(cube_of_ten(), {"inside:" + path.string() + "=0.5"});
  EXPECT_LE(mean_volume_in(r.mesh, {{0, 0, 0}, {1.5, 1.5, 1.5}}), 0.126);
  EXPECT_GT(mean_volume_in(r.mesh, {{7, 7, 7}, {10, 10, 10}}), 1.5);
  std::ofstream(path) << "OFF\n3 1 0\n0 0 0\n9 0 0\n0 9 0\n3 0 1 2\n";
  EXPECT_THROW(mesh_with(cube_of_ten(), {"inside:" + path.string() + "=0.5"}), Error);
}

/// 0.5 on the left, 2 in the middle and beyond, in between in proportion.
std::string write_image(const std::filesystem::path& path) {
  std::ofstream(path) << R"(<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian">
<ImageData WholeExtent="0 2 0 1 0 1" Origin="0 0 0" Spacing="5 10 10">
<Piece Extent="0 2 0 1 0 1"><PointData>
<DataArray type="Float64" Name="size" format="ascii">0.5 2 2 0.5 2 2 0.5 2 2 0.5 2 2</DataArray>
<DataArray type="Float64" Name="other" format="ascii">1 1 1 1 1 1 1 1 1 1 1 1</DataArray>
</PointData></Piece></ImageData></VTKFile>)";
  return path.string();
}

TEST(SizePlaces, AFieldFromAnImageGivesSizes) {
  const test::TempFolder folder;
  const std::string image = write_image(folder / "sizes.vti");
  const MeshResult r = mesh_with(cube_of_ten(), {"field:" + image});
  EXPECT_TRUE(r.failures.empty());
  EXPECT_LE(mean_volume_in(r.mesh, {{0, 0, 0}, {0.4, 10, 10}}), 0.15);  // 0.5 to 0.62 there
  EXPECT_GT(mean_volume_in(r.mesh, {{6.5, 0, 0}, {10, 10, 10}}), 2);
  // Everywhere at most what the field says there, and no finer than the least in a cell, and the
  // balance, ask for.
  for (CellId c : r.grid.cells.ids()) {
    const Box3 box = cell_box(r.grid, c);
    const Vec3 p = box.center();
    if (!Box3{{0, 0, 0}, {10, 10, 10}}.contains(p)) continue;
    const double asked = p.x < 5 ? 0.5 + 0.3 * p.x : 2;
    EXPECT_LE(box.extent().x, asked * (1 + 1e-6));
    EXPECT_GT(box.extent().x, std::min(0.5 + 0.3 * box.lo.x, 2.0) / 4) << p.x;
  }
  const MeshResult other = mesh_with(cube_of_ten(), {"field:" + image + "=other"}, 2);
  EXPECT_LE(mean_volume_in(other.mesh, {{6, 0, 0}, {10, 10, 10}}), 1.01);
  EXPECT_GT(mean_volume_in(other.mesh, {{6, 0, 0}, {10, 10, 10}}), 0.4);
}

TEST(SizePlaces, AFieldFromAGridGivesSizes) {
  // One hex, its sizes at its corners.
  const test::TempFolder folder;
  const auto path = folder / "sizes.vtu";
  std::ofstream(path) << R"(<VTKFile type="UnstructuredGrid" version="1.0">
<UnstructuredGrid><Piece NumberOfPoints="8" NumberOfCells="1">
<PointData><DataArray type="Float32" Name="h" format="ascii">.5 2 2 .5 .5 2 2 .5</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 10 0 0 10 10 0 0 10 0 0 0 10 10 0 10 10 10 10 0 10 10</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 4 5 6 7</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">8</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">12</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>)";
  const MeshResult r = mesh_with(cube_of_ten(), {"field:" + path.string()});
  EXPECT_LE(mean_volume_in(r.mesh, {{0, 0, 0}, {0.4, 10, 10}}), 0.15);  // 0.5 to 0.62 there
  EXPECT_GT(mean_volume_in(r.mesh, {{8, 0, 0}, {10, 10, 10}}), 0.4);
  try {
    parse_size_rule("field:" + path.string() + "=size");
    ADD_FAILURE() << "no such array";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("there is h"), std::string::npos) << error.what();
  }
  EXPECT_THROW(parse_size_rule("field:sizes.csv"), Error);
  EXPECT_THROW(parse_size_rule("field:"), Error);
}

/// A field of one function of the place.
SizeRule by_place(std::function<double(const Vec3&)> size) {
  PointField field;
  field.between = [size = std::move(size)](std::span<const Vec3> places, std::span<double> sizes) {
    std::transform(places.begin(), places.end(), sizes.begin(), size);
  };
  SizeRule rule;
  rule.where = SizeRule::Where::Field;
  rule.text = "a function";
  rule.field = std::make_shared<const PointField>(std::move(field));
  return rule;
}

MeshResult mesh_by(const SizeRule& rule) {
  MeshOptions options;
  options.sizes.rules = {rule};
  return mesh_surface(cube_of_ten(), options, {});
}

TEST(SizePlaces, AConstantFunctionIsMetExactly) {
  EXPECT_EQ(mesh_by(by_place([](const Vec3&) { return 0.625; })).mesh.num_hexes(), 16u * 16 * 16);
}

TEST(SizePlaces, AFunctionOfThePlaceBoundsCells) {
  const MeshResult r = mesh_by(by_place([](const Vec3& p) { return p.x < 5 ? 0.625 : kNone; }));
  EXPECT_TRUE(r.failures.empty());
  EXPECT_LE(mean_volume_in(r.mesh, {{0, 0, 0}, {4, 10, 10}}), std::pow(0.625, 3) * 1.01);
  EXPECT_GT(mean_volume_in(r.mesh, {{8, 0, 0}, {10, 10, 10}}), 1);
}

TEST(SizePlaces, AFieldOfTheSurfaceLeavesTheInsideCoarser) {
  SizeRule rule = by_place([](const Vec3&) { return 0.625; });
  rule.is_at_surface = true;
  const MeshResult r = mesh_by(rule);
  EXPECT_TRUE(r.failures.empty());
  EXPECT_LE(mean_volume_in(r.mesh, {{0, 0, 0}, {10, 10, 0.7}}), std::pow(0.625, 3) * 1.01);
  EXPECT_LT(r.mesh.num_hexes(), 16u * 16 * 16);
}

TEST(SizePlaces, SizesThatAreNoLengthsAreRefusedWithTheirPlace) {
  const auto message = [](const SizeRule& rule) {
    MeshOptions options;
    options.sizes.rules = {rule};
    return message_of(cube_of_ten(), options);
  };
  for (const double wrong : {0.0, -1.0, std::nan("")}) {
    const std::string said = message(by_place([=](const Vec3& p) { return p.x < 5 ? 1 : wrong; }));
    EXPECT_NE(said.find("the size at (5, 0, 0) is"), std::string::npos) << said;
    EXPECT_NE(said.find("give lengths above 0"), std::string::npos) << said;
    SizeRule points = by_place({});
    points.field = std::make_shared<const PointField>(PointField{{{1, 2, 3}}, {wrong}, {}});
    EXPECT_NE(message(points).find("the size at (1, 2, 3) is"), std::string::npos);
  }
}

TEST(SizePlaces, NoFieldRefinesBeyondTheBudgetOrTheDeepestLevel) {
  std::atomic<std::size_t> num_asked = 0;
  MeshOptions options;
  options.sizes.rules = {by_place([&](const Vec3&) {
    ++num_asked;
    return 1e-5;
  })};
  options.most_hexes = 10'000;
  EXPECT_NE(message_of(cube_of_ten(), options).find("ask for larger cells"), std::string::npos);
  EXPECT_LT(num_asked, 27u * 100'000);
  options.most_hexes = 0;
  options.sizing.max_cells = options.max_hexes = 100'000;
  EXPECT_NE(message_of(cube_of_ten(), options).find("ask for larger cells"), std::string::npos);
  // One point alone: no budget ends that.
  PointField point{{{3, 3, 3}}, {1e-300}, {}};
  options.sizes.rules[0].field = std::make_shared<const PointField>(std::move(point));
  options.sizes.max_size = {2, false};
  EXPECT_NE(message_of(cube_of_ten(), options).find("ask for larger cells"), std::string::npos);
}

TEST(SizePlaces, LengthsHaveUnitsWhereTheSurfacesIsKnown) {
  MeshOptions options;
  options.sizes.size = parse_length("10mm");
  EXPECT_NE(message_of(cube_of_ten(), options).find("--unit"), std::string::npos);
  options.sizes.unit = 0.01;
  const MeshResult r = mesh_surface(cube_of_ten(), options, {});
  EXPECT_EQ(r.mesh.num_hexes(), 1000u);
  EXPECT_DOUBLE_EQ(r.size_asked, 1);
  EXPECT_DOUBLE_EQ(parse_length("0.5in").metres, 0.0254);
  EXPECT_DOUBLE_EQ(parse_margin("3m,2L,1")[0].metres, 1);
  options.sizes = {};
  options.layers.specs = {parse_layer_spec("*=first:1mm,growth:1.2,count:2")};
  EXPECT_NE(message_of(cube_of_ten(), options).find("--unit"), std::string::npos);
}

TEST(SizePlaces, TheDeepestLevelBindsWhereItIsGiven) {
  MeshOptions options;
  OptionTable table = make_option_table(options);
  find_option(table, "max-level")->set("3");
  const auto refused = [&](auto&& wish) {
    MeshOptions wishes = options;
    wish(wishes.sizes);
    return message_of(cube_of_ten(), wishes);
  };
  const std::string size =
      refused([](SizeWishes& w) { w.rules = {parse_size_rule("ball:0,0,0,1=0.1")}; });
  EXPECT_NE(size.find("--max-level is 3"), std::string::npos) << size;
  EXPECT_NE(size.find("ball:0,0,0,1=0.1"), std::string::npos) << size;
  options.sizes.across = 8;
  const MeshResult r = mesh_surface(test::box_surface({0, 0, 0}, {10, 10, 1}), options, {});
  EXPECT_LE(r.grid.finest_level, 4);  // completion may add one
  EXPECT_TRUE(std::any_of(r.warnings.begin(), r.warnings.end(), [](const std::string& warning) {
    return warning.find("--across 8") != std::string::npos;
  }));
}

TEST(SizePlaces, TheReportHasTheSizesAndWhatFollowed) {
  MeshOptions options;
  options.sizes.size = {10, true};
  options.sizes.rules = {parse_size_rule("ball:0,0,0,1=0.5")};
  options.sizes.growth = 1.5;
  const MeshResult r = mesh_surface(cube_of_ten(), options, {});
  const auto json = nlohmann::json::parse(report_to_json(r, {"a", "b", 1, {}}));
  const auto& sizes = json["options"]["sizes"];
  EXPECT_EQ(sizes["refine"][0], "ball:0,0,0,1=0.5");
  EXPECT_EQ(sizes["growth"], 1.5);
  EXPECT_TRUE(sizes["max_size"].is_null());
  EXPECT_EQ(json["options"]["tolerance"], json["edges"]["tolerance_used"]);
  EXPECT_EQ(json["options"]["mean_share"], 0);
  EXPECT_GT(json["edges"]["size_used"].get<double>(), 0);
}

TEST(SizePlaces, TheSidesOfEveryDomainAreNamed) {
  MeshOptions options;
  options.fit.carve.side = Side::Outside;
  options.sizing.tolerance = 0.02;
  const MeshResult r = mesh_surface(test::unit_sphere_surface(3), options, {});
  std::set<std::string> names;
  for (const std::string& name : r.mesh.labels.patch_names)
    if (!name.empty()) names.insert(name);
  EXPECT_EQ(names, (std::set<std::string>{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"}));
  EXPECT_EQ(r.mesh.labels.quads.size(), compute_hex_neighbors(r.mesh).boundary.size());
}

/// A box of 4 x 2 x 1 on the ground, or through it: the same.
TEST(Domain, CutsTheObjectAtItsSides) {
  for (double bottom : {0.0, -1.0}) {
    MeshOptions options;
    options.fit.carve.side = Side::Outside;
    options.sizes.box = parse_box("-4,-3,0,9,5,4");
    options.sizes.size = {0.25, false};
    options.sizes.max_size = {1, false};
    const MeshResult r = mesh_surface(test::box_surface({0, 0, bottom}, {4, 2, 1}), options, {});
    EXPECT_TRUE(r.failures.empty()) << r.failures.front();
    EXPECT_NEAR(r.verdict.quality.total_volume, 13 * 8 * 4 - 8, 0.1);
    EXPECT_LE(r.verdict.distance->max_two_way(), r.options.sizing.tolerance);
    EXPECT_EQ(r.fit.num_curves, 8u);  // none around the bottom
    EXPECT_EQ(r.fit.num_curves_mapped, 8u);
    EXPECT_GE(r.verdict.features->num_corners_recovered, 7u);
    // Upright creases end on the ground.
    for (double x : {0.0, 4.0})
      for (double y : {0.0, 2.0}) {
        double nearest = 1;
        for (const Vec3& p : r.mesh.positions) nearest = std::min(nearest, distance(p, {x, y, 0}));
        EXPECT_LE(nearest, 0.1 * 0.25) << x << " " << y;
      }
  }
}

TEST(SharedBudget, PartsShareWhatIsAllowed) {
  MeshOptions options;
  options.max_hexes = 1000;
  options.max_loop_hexes = 2000;
  const TriMesh part = cube_of_ten();
  SharedBudget budget(options, {part, part});
  const MeshOptions first = budget.allow(options);
  EXPECT_EQ(first.max_hexes, 750u);
  EXPECT_EQ(first.max_loop_hexes, 1500u);
  MeshResult result;
  result.grid = split_cells(make_root_grid({}), {1});
  ASSERT_EQ(result.grid.num_cells(), 8u);
  result.rounds.resize(2);
  result.rounds[0].num_background = 600;
  result.rounds[1].num_background = 700;
  budget.spend(result);
  const MeshOptions second = budget.allow(options);
  EXPECT_EQ(second.max_loop_hexes, 700u);
  EXPECT_EQ(second.max_hexes, 992u);
  EXPECT_EQ(second.sizing.max_cells, options.sizing.max_cells - 8);
}

TEST(SharedBudget, APartThatTookTooMuchLeavesTheNextItsOwn) {
  MeshOptions options;
  options.max_loop_hexes = 2000;
  const TriMesh part = cube_of_ten();
  SharedBudget budget(options, {part, part});
  MeshResult result;
  result.rounds.resize(1);
  result.rounds[0].num_background = 5000;
  budget.spend(result);
  EXPECT_EQ(budget.allow(options).max_loop_hexes, 500u);
}

TEST(SizeWishes, AFileIsReadByTheTableOfOptions) {
  const test::TempFolder folder;
  const std::string path = (folder / "size_table.json").string();
  const auto refused = [&](const char* text) {
    std::ofstream(path) << text;
    SizeWishes wishes;
    try {
      read_size_wishes(path, wishes);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(refused(R"({"across": 500})").find("500"), std::string::npos);
  EXPECT_NE(refused(R"({"cells": -1})").find("cells"), std::string::npos);
  EXPECT_NE(refused(R"({"hue": 1})").find("margin"), std::string::npos);
  for (const char* empty : {R"({"size": []})", R"({"box": []})", R"({"margin": []})"})
    EXPECT_NE(refused(empty), "accepted") << empty;
  EXPECT_EQ(refused(R"({"unit": "mm", "size": "2cm", "refine": [], "box": [0,0,0,1,1,1]})"),
            "accepted");
}

}  // namespace
}  // namespace hexwright
