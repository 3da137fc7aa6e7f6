// Exodus files of any program: what sets of nodes mean, and what is refused.
#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/io/mesh_io.h"

#include "io/sample_meshes.h"
#include "io/temp_folder.h"
#include "io/text/netcdf_writer.h"

namespace hexwright {
namespace {

using test::TempFolder;
using Numbers = std::vector<std::int32_t>;

/// A column of cubes along x in the numbering of test::box_hex_mesh, as an Exodus file.
struct ExodusColumn {
  int length = 3;
  std::string type = "HEX8";
  std::vector<std::pair<std::string, Numbers>> node_sets;  ///< counted from 0
  Numbers side_elements, sides;
  bool has_triangle = false;  ///< in a block of its own
  int lost_nodes = 0;         ///< how many fewer coordinates there are than the dimension says

  std::string bytes() const {
    const HexMesh mesh = test::box_hex_mesh(length, 1, 1);
    io::NetcdfWriter out;
    const auto width = out.dimension("len_name", 33);
    const auto nodes = out.dimension("num_nodes", mesh.num_verts());
    const auto fewer = out.dimension("fewer", mesh.num_verts() - std::size_t(lost_nodes));
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (const Vec3& p : mesh.positions) values.push_back(p[axis]);
      values.resize(mesh.num_verts() - std::size_t(lost_nodes));
      out.doubles(
          std::string("coord") + "xyz" [axis], { lost_nodes ? fewer : nodes }, values);
    }
    Numbers connectivity;
    for (const auto& hex : mesh.hexes)
      for (VertId v : hex) connectivity.push_back(v.value() + 1);
    const auto blocks = out.dimension("num_el_blk", has_triangle ? 2 : 1);
    out.ints("eb_prop1", {blocks}, has_triangle ? Numbers{4, 5} : Numbers{4});
    out.ints("connect1",
             {out.dimension("num_el_in_blk1", mesh.num_hexes()), out.dimension("eight", 8)},
             connectivity, {"elem_type", type});
    if (has_triangle)
      out.ints("connect2", {out.dimension("num_el_in_blk2", 1), out.dimension("three", 3)},
               Numbers{1, 2, 3}, {"elem_type", "TRI3"});
    if (!side_elements.empty()) {
      out.ints("ss_prop1", {out.dimension("num_side_sets", 1)}, Numbers{9});
      const auto size = out.dimension("num_side_ss1", side_elements.size());
      out.ints("elem_ss1", {size}, side_elements);
      out.ints("side_ss1", {size}, sides);
    }
    if (!node_sets.empty()) add_node_sets(out, width);
    return out.take();
  }

  void add_node_sets(io::NetcdfWriter& out, std::int32_t width) const {
    const auto count = out.dimension("num_node_sets", node_sets.size());
    std::vector<std::string> names;
    for (const auto& [name, nodes] : node_sets) {
      names.push_back(name);
      Numbers from_one;
      for (const std::int32_t v : nodes) from_one.push_back(v + 1);
      const std::string number = std::to_string(names.size());
      out.ints("node_ns" + number, {out.dimension("num_nod_ns" + number, nodes.size())}, from_one);
    }
    out.texts("ns_names", {count, width}, names, 33);
  }
};

std::string refusal(const ExodusColumn& column) {
  const TempFolder folder;
  try {
    read_hex_mesh(folder.write("a.exo", column.bytes()));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadFile);
    return error.what();
  }
  return "accepted";
}

/// Of a column of three cubes.
Numbers nodes_where(bool (*is_in)(const Vec3&)) {
  const HexMesh mesh = test::box_hex_mesh(3, 1, 1);
  Numbers nodes;
  for (VertId v : mesh.positions.ids())
    if (is_in(mesh.positions[v])) nodes.push_back(v.value());
  return nodes;
}

TEST(Exodus, SetsOfNodesMeanWhatTheirNodesForm) {
  ExodusColumn column;
  const auto at_start = [](const Vec3& p) { return p.x == 0; };
  const auto along_edge = [](const Vec3& p) { return p.y == 0 && p.z == 0; };
  const auto apart = [](const Vec3& p) {
    return (p.x == 0) == (p.y == 0) && p.z == 1 && (p.x == 0 || p.x == 3);
  };
  const auto all = [](const Vec3&) { return true; };
  column.node_sets = {{"start", nodes_where(at_start)},
                      {"edge", nodes_where(along_edge)},
                      {"pins", nodes_where(apart)},
                      {"everything", nodes_where(all)}};
  const TempFolder folder;
  const HexMesh mesh = read_hex_mesh(folder.write("a.exo", column.bytes()));
  const SetTable table = make_set_table(mesh);
  ASSERT_EQ(table.regions.size(), 1u);
  EXPECT_EQ(table.regions[0].name, "block_4");
  ASSERT_EQ(table.patches.size(), 1u) << "everything is no patch";
  EXPECT_EQ(table.patches[0].name, "start");
  EXPECT_EQ(table.patches[0].members.size(), 1u);
  ASSERT_EQ(table.curves.size(), 1u);
  EXPECT_EQ(table.curves[0].name, "edge");
  EXPECT_EQ(table.curves[0].members.size(), 3u);
  EXPECT_EQ(mesh.labels.corners.size(), 2u);
}

TEST(Exodus, SidesAreTheFacesOfTheManual) {
  for (const auto& [side, lf] :
       std::vector<std::pair<int, int>>{{1, 2}, {2, 1}, {3, 3}, {4, 0}, {5, 4}, {6, 5}}) {
    ExodusColumn column;
    column.length = 1;
    column.side_elements = {1};
    column.sides = {side};
    const TempFolder folder;
    const HexMesh mesh = read_hex_mesh(folder.write("a.exo", column.bytes()));
    ASSERT_EQ(mesh.labels.quads.size(), 1u);
    EXPECT_EQ(mesh.labels.quads[0].verts, face_verts(mesh, {HexId(0), lf}));
    EXPECT_EQ(make_set_table(mesh).patches[0].name, "sideset_9");
  }
}

TEST(Exodus, BlocksOfTrianglesAreLeftOut) {
  ExodusColumn column;
  column.has_triangle = true;
  const TempFolder folder;
  const HexMesh mesh = read_hex_mesh(folder.write("a.exo", column.bytes()));
  EXPECT_EQ(mesh.num_hexes(), 3u);
  EXPECT_TRUE(mesh.labels.quads.empty());
}

TEST(Exodus, WhatCannotBeReadIsNamedWithItsPlace) {
  ExodusColumn column;
  column.type = "WEDGE15";
  EXPECT_NE(refusal(column).find("a.exo: block 'block_4': it holds elements 'WEDGE15'"),
            std::string::npos);
  column.type = "HEX8";
  column.side_elements = {4};
  column.sides = {1};
  EXPECT_NE(refusal(column).find("side set 'sideset_9': it names element 4 of 3"),
            std::string::npos);
  column.side_elements = {3};
  column.sides = {7};
  EXPECT_NE(refusal(column).find("there is no side 7"), std::string::npos);
  column.side_elements.clear();
  column.node_sets = {{"pins", {99}}};
  EXPECT_NE(refusal(column).find("node set 'pins': it names node 100 of 16"), std::string::npos);
  column.node_sets.clear();
  column.lost_nodes = 5;
  EXPECT_NE(refusal(column).find("variable 'coordx': it has 11 numbers for 16 nodes"),
            std::string::npos);
}

TEST(Exodus, OtherNetcdfFilesAreRefused) {
  const TempFolder folder;
  io::NetcdfWriter out;
  out.doubles("temperature", {out.dimension("day", 2)}, std::vector<double>{1, 2});
  try {
    read_hex_mesh(folder.write("a.nc", out.take()));
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no Exodus mesh"), std::string::npos) << error.what();
  }
  EXPECT_THROW(read_hex_mesh(folder.write("a.exo", "\x89HDF\r\n\x1a\n and more")), Error);
  EXPECT_THROW(read_hex_mesh(folder.write("b.exo", "no mesh")), Error);
}

}  // namespace
}  // namespace hexwright
